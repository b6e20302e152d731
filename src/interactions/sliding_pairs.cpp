#include "interactions/sliding_pairs.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "interactions/pairing/contact_face.h"

namespace pounding::interactions {
namespace {

Vector3 plus(const Vector3& a, const Vector3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

}  // namespace

std::vector<ConstraintTerm> SlidingPairs::all_terms(const SlidingFaces& faces) {
  std::vector<ConstraintTerm> terms;
  for (const SlidingFaces::Node& node : faces.nodes) {
    for (int d = 0; d < 3; ++d) terms.push_back({node.structure, node.node, d, 0});
  }
  return terms;
}

SlidingPairs::SlidingPairs(const ContactOperator& contact, const Interface& interface)
    : faces_(interface.sliding), pairs_(faces_.rows.size()), changed_(faces_.rows.size(), 0) {
  for (const SlidingFaces::Node& node : faces_.nodes) {
    std::array<int, 3>& columns = columns_.emplace_back();
    for (int d = 0; d < 3; ++d) columns[d] = contact.column(node.structure, node.node, d);
  }
  const std::vector<double> rest(contact.dof_list().size(), 0.0);
  for (std::size_t row = 0; row < faces_.rows.size(); ++row) pair(row, rest);
}

Vector3 SlidingPairs::displacement_of(int node, std::span<const double> displacement) const {
  Vector3 u{0, 0, 0};
  for (std::size_t d = 0; d < 3; ++d) {
    const int column = columns_[node][d];
    if (column >= 0) u[d] = displacement[column];
  }
  return u;
}

Vector3 SlidingPairs::relative(std::size_t row, const Pair& pair,
                               std::span<const double> displacement) const {
  Vector3 u = displacement_of(faces_.rows[row].node, displacement);
  const SlidingFaces::Facet& facet = faces_.facets[pair.facet];
  for (int a = 0; a < facet.count; ++a) {
    const Vector3 corner = displacement_of(facet.nodes[a], displacement);
    for (std::size_t d = 0; d < 3; ++d) u[d] -= pair.weights[a] * corner[d];
  }
  return u;
}

double SlidingPairs::slid(std::size_t row, std::span<const double> displacement) const {
  const Pair& pair = pairs_[row];
  const Vector3 moved = minus(relative(row, pair, displacement), pair.slip);
  return norm(part_across(moved, faces_.rows[row].normal)) / faces_.facets[pair.facet].size;
}

void SlidingPairs::pair(std::size_t row, std::span<const double> displacement) {
  const SlidingFaces::Row& node = faces_.rows[row];
  const Vector3 origin =
      plus(faces_.nodes[node.node].position, displacement_of(node.node, displacement));
  std::optional<double> best;
  Pair found;
  found.facet = faces_.candidates[node.first];
  found.weights = {1, 0, 0, 0};
  for (int k = node.first; k < node.end; ++k) {
    const int number = faces_.candidates[k];
    const SlidingFaces::Facet& facet = faces_.facets[number];
    std::array<Vector3, 4> corners{};
    for (int a = 0; a < facet.count; ++a) {
      corners[a] = plus(faces_.nodes[facet.nodes[a]].position,
                        displacement_of(facet.nodes[a], displacement));
    }
    const auto point = meet_corners(std::span(corners).first(static_cast<std::size_t>(facet.count)),
                                    origin, node.normal, facet_tolerance);
    if (!point) continue;
    const double gap = point->distance - node.half_thickness - facet.half_thickness;
    const double margin = 1e-9 * facet.size;
    if (gap < -node.depth - facet_tolerance * facet.size) continue;
    if (best && std::abs(gap) >= std::abs(*best) - margin) continue;
    best = gap;
    found = {number, snapped(point->weights), {}, false};
  }
  found.slip = relative(row, found, displacement);
  pairs_[row] = found;
}

void SlidingPairs::put(std::size_t row, std::span<Constraint> rows) const {
  const SlidingFaces::Row& node = faces_.rows[row];
  const Pair& pair = pairs_[row];
  const SlidingFaces::Facet& facet = faces_.facets[pair.facet];
  Constraint& constraint = rows[static_cast<std::size_t>(node.constraint)];
  constraint.terms.clear();
  constraint.matched = false;
  const auto add = [&](int number, double weight) {
    const SlidingFaces::Node& place = faces_.nodes[number];
    add_terms(place.structure, place.node, weight, node.normal, constraint);
  };
  double gap = node.offset - node.half_thickness - facet.half_thickness;
  for (int a = 0; !pair.open && a < facet.count; ++a) {
    if (pair.weights[a] == 0) continue;
    add(facet.nodes[a], pair.weights[a]);
    gap += pair.weights[a] * dot(node.normal, minus(faces_.nodes[facet.nodes[a]].position,
                                                    faces_.nodes[node.node].position));
  }
  add(node.node, -1);
  constraint.initial_gap = pair.open ? open_gap : gap;
}

void SlidingPairs::set_time_step(double time_step) {
  stride_ = static_cast<int>(std::clamp(longest_time / time_step, 1.0, 1.0 * most_calls));
}

bool SlidingPairs::find(std::span<const double> displacement, std::span<Constraint> rows) {
  if (++calls_ < stride_) return false;
  calls_ = 0;
  double farthest = 0;
  for (std::size_t row = 0; row < faces_.rows.size(); ++row) {
    farthest = std::max(farthest, slid(row, displacement));
  }
  if (!(farthest > limit)) return false;
  // Neighbours that are on the way go along: one search for all of them.
  for (std::size_t row = 0; row < faces_.rows.size(); ++row) {
    if (slid(row, displacement) <= limit / 2) continue;
    pair(row, displacement);
    put(row, rows);
    changed_[row] = 1;
  }
  return true;
}

void SlidingPairs::keep(const StateKeeper& state, std::span<Constraint> rows) {
  if (faces_.rows.empty()) return;
  state.rows("contact_pairs", pairs_.size(), [&](std::size_t row, const auto& take) {
    Pair& pair = pairs_[row];
    auto& [a, b, c, d] = pair.weights;
    take(changed_[row], pair.facet, pair.open, a, b, c, d, pair.slip[0], pair.slip[1],
         pair.slip[2]);
  });
  state.numbers("contact_pairs_calls", calls_);
  for (std::size_t row = 0; !state.puts() && row < pairs_.size(); ++row) {
    if (changed_[row] != 0) put(row, rows);
  }
}

}  // namespace pounding::interactions
