#include "interactions/pairing/interface.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

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

/// Rows of the weights of constraints along the directions that `directions_of` gives for a normal.
std::vector<Constraint> rows_along(std::span<const Constraint> constraints,
                                   const auto& directions_of) {
  std::vector<Constraint> rows;
  for (const Constraint& constraint : constraints) {
    const Vector3 normal = normal_of(constraint);
    const std::vector<ConstraintTerm> nodes = weights_of(constraint, normal);
    for (const Vector3& direction : directions_of(normal)) {
      Constraint& row = rows.emplace_back();
      row.contact = constraint.contact;
      row.friction = constraint.friction;
      for (const ConstraintTerm& node : nodes) {
        for (int d = 0; d < 3; ++d) {
          const double coefficient = node.coefficient * direction[d];
          if (coefficient != 0) row.terms.push_back({node.structure, node.node, d, coefficient});
        }
      }
    }
  }
  return rows;
}

/// A weight this close to 1 is the node itself; one this close to 0 is not there.
constexpr double negligible = 1e-6;

}  // namespace

void drop_repeated(std::size_t first, Interface& interface, InterfaceReport& report) {
  constexpr double digits = 1e6;  // of a normal, from either side
  using Terms = std::set<std::tuple<int, GlobalIndex, int, long>>;
  std::set<Terms> known;
  const auto kept =
      std::remove_if(interface.constraints.begin() + static_cast<std::ptrdiff_t>(first),
                     interface.constraints.end(), [&](const Constraint& row) {
                       Terms terms;
                       for (const ConstraintTerm& term : row.terms) {
                         const long rounded = std::lround(digits * term.coefficient);
                         if (rounded == 0) continue;
                         terms.emplace(term.structure, term.node, term.component, rounded);
                       }
                       return row.matched && !known.insert(terms).second;
                     });
  const auto repeated = static_cast<int>(interface.constraints.end() - kept);
  report.pairs -= repeated;
  report.matched -= repeated;
  interface.constraints.erase(kept, interface.constraints.end());
}

bool has_fillers(const Interface& interface) {
  return std::ranges::any_of(interface.constraints,
                             [](const Constraint& c) { return c.filler.area > 0; });
}

std::vector<NodeLink> facing_nodes(const Interface& interface) {
  std::vector<NodeLink> links;
  for (const Constraint& constraint : interface.constraints) {
    const ConstraintTerm& secondary = constraint.terms.back();
    for (const ConstraintTerm& term : constraint.terms) {
      if (term.structure != secondary.structure || term.node != secondary.node) {
        links.push_back({secondary.structure, secondary.node, term.structure, term.node});
      }
    }
  }
  return links;
}

std::array<int, 2> axes_across(const Vector3& normal) {
  int normal_axis = 0;
  for (int d = 1; d < 3; ++d) {
    if (std::abs(normal[d]) > std::abs(normal[normal_axis]) + 1e-9) normal_axis = d;
  }
  return {normal_axis == 0 ? 1 : 0, normal_axis == 2 ? 1 : 2};
}

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
  return rows_along(constraints, tangents_of);
}

std::vector<Constraint> component_rows(std::span<const Constraint> constraints) {
  return rows_along(constraints, [](const Vector3& /*normal*/) {
    return std::array<Vector3, 3>{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  });
}

std::array<double, 4> snapped(std::array<double, 4> weights) {
  for (double& weight : weights) {
    if (std::abs(weight) <= negligible) weight = 0;
  }
  for (std::size_t a = 0; a < weights.size(); ++a) {
    if (weights[a] <= 1 - negligible) continue;
    weights.fill(0);
    weights[a] = 1;
  }
  return weights;
}

void add_terms(int structure, GlobalIndex node, double weight, const Vector3& normal,
               Constraint& constraint) {
  for (int d = 0; d < 3; ++d) {
    const double coefficient = weight * normal[d];
    if (coefficient != 0) constraint.terms.push_back({structure, node, d, coefficient});
  }
}

}  // namespace pounding::interactions
