#include "interactions/pairing/tangential_rows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/matrix3.h"

namespace pounding::interactions {
namespace {

/// The weight of every node of a constraint, -1 for the secondary altogether.
std::vector<ConstraintTerm> weights_of(const Constraint& constraint, const Vector3& normal) {
  std::vector<ConstraintTerm> nodes;
  for (const ConstraintTerm& term : constraint.terms) {
    if (nodes.empty() || nodes.back().structure != term.structure ||
        nodes.back().node != term.node) {
      nodes.push_back({term.structure, term.node, 0, 0});
    }
    nodes.back().coefficient += term.coefficient * normal[term.component];
  }
  return nodes;
}

}  // namespace

std::array<Vector3, 2> tangents_of(const Vector3& normal) {
  const std::size_t smallest =
      std::ranges::min_element(normal, {}, [](double x) { return std::abs(x); }) - normal.begin();
  Vector3 axis{0, 0, 0};
  axis[smallest] = 1;
  const Vector3 first = normalised(cross(normal, axis));
  return {first, cross(normal, first)};
}

Vector3 normal_of(const Constraint& constraint) {
  Vector3 normal{0, 0, 0};
  const ConstraintTerm& last = constraint.terms.back();
  for (const ConstraintTerm& term : constraint.terms) {
    if (term.structure == last.structure && term.node == last.node) {
      normal[term.component] = -term.coefficient;
    }
  }
  return normalised(normal);  // where edges cross, the secondary node has a part only
}

std::vector<Constraint> tangential_rows(std::span<const Constraint> constraints) {
  std::vector<Constraint> rows;
  for (const Constraint& constraint : constraints) {
    const Vector3 normal = normal_of(constraint);
    const std::vector<ConstraintTerm> nodes = weights_of(constraint, normal);
    for (const Vector3& tangent : tangents_of(normal)) {
      Constraint& row = rows.emplace_back();
      row.contact = constraint.contact;
      row.friction = constraint.friction;
      for (const ConstraintTerm& node : nodes) {
        for (int d = 0; d < 3; ++d) {
          const double coefficient = node.coefficient * tangent[d];
          if (coefficient != 0) row.terms.push_back({node.structure, node.node, d, coefficient});
        }
      }
    }
  }
  return rows;
}

}  // namespace pounding::interactions
