#include "mesh/followed_facets.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/matrix3.h"
#include "elements/element_traits.h"

namespace pounding {
namespace {

/// Parts of a facet's longest edge: offsets up to `nothing` are none; points nearer to each other
/// than `same_point` are one.
constexpr double nothing = 1e-13;
constexpr double same_point = 1e-6;

/// Where a facet turns, arms up to this length are eccentricities of beams and slabs, however fine
/// the mesh [m].
constexpr double longest_arm = 1;

/// Distance along one axis between two intervals.
double between(double low, double high, double other_low, double other_high) {
  return std::max({low - other_high, other_low - high, 0.0});
}

double box_distance(const BoundingBox& a, const BoundingBox& b) {
  double square = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const double out = between(a.low[d], a.high[d], b.low[d], b.high[d]);
    square += out * out;
  }
  return std::sqrt(square);
}

/// Turn of a face, at its place, for a displacement of corner i.
Vector3 turn_of(const FacetPoint& at, std::size_t i, const Vector3& u) {
  const Vector3 tilt = cross(at.gradients[i], at.normal);
  const double out = dot(at.normal, u);
  const double drill = dot(cross(at.normal, at.gradients[i]), u) / 2;
  Vector3 turn{};
  for (std::size_t d = 0; d < 3; ++d) turn[d] = tilt[d] * out + at.normal[d] * drill;
  return turn;
}

}  // namespace

std::vector<Vector3> corners_of(const GlobalMesh& mesh, const Facet& facet) {
  std::vector<Vector3> corners;
  for (const GlobalIndex node : facet.corners()) corners.push_back(mesh.position(node));
  return corners;
}

BoundingBox box_of(const std::vector<Vector3>& points) {
  BoundingBox box;
  for (const Vector3& x : points) box.include(x);
  return box;
}

Carrier& carrier_of(GlobalIndex node, std::vector<Carrier>& carriers) {
  const auto found = std::ranges::find(carriers, node, &Carrier::node);
  return found != carriers.end() ? *found : carriers.emplace_back(Carrier{node, {}});
}

FollowedFacets::FollowedFacets(const GlobalMesh& mesh, const std::vector<Facet>& facets)
    : mesh_(mesh), facets_(facets) {
  for (const Facet& facet : facets_) {
    boxes_.push_back(box_of(corners_of(mesh_, facet)));
    reaches_.push_back(reach(facet));
  }
  find_bending();
}

double FollowedFacets::longest_edge(const Facet& facet) const {
  const std::vector<Vector3> corners = corners_of(mesh_, facet);
  double longest = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    longest = std::max(longest, pounding::distance(corners[i], corners[(i + 1) % corners.size()]));
  }
  return longest;
}

bool FollowedFacets::turns(const Facet& facet) const {
  return std::ranges::all_of(facet.corners(), [this](GlobalIndex node) {
    return (mesh_.components[node] & rotation_bits) == rotation_bits;
  });
}

double FollowedFacets::reach(const Facet& facet) const {
  const double edge = longest_edge(facet);
  return turns(facet) ? std::max(edge, longest_arm) : edge;
}

std::vector<FollowedPoint> FollowedFacets::nearest(const Vector3& x) const {
  std::vector<FollowedPoint> found;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    const double margin = same_point * boxes_[f].diagonal();
    if (box_distance(boxes_[f], {x, x}) > least + margin) continue;
    const FollowedPoint followed{&facets_[f], nearest_point(corners_of(mesh_, facets_[f]), x)};
    if (followed.at.distance > least + margin) continue;
    found.push_back(followed);
    least = std::min(least, followed.at.distance);
  }
  const FollowedPoint best = *std::ranges::min_element(
      found, {}, [](const FollowedPoint& followed) { return followed.at.distance; });
  const double margin = same_point * longest_edge(*best.facet);
  std::erase_if(found, [&](const FollowedPoint& followed) {
    return pounding::distance(followed.at.x, best.at.x) > margin ||
           turns(*followed.facet) != turns(*best.facet) ||
           followed.facet->count != best.facet->count;
  });
  return found;
}

std::vector<const Facet*> FollowedFacets::near(const BoundingBox& box) const {
  std::vector<const Facet*> found;
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    if (box_distance(boxes_[f], box) <= reaches_[f]) found.push_back(&facets_[f]);
  }
  return found;
}

void FollowedFacets::follow(const FollowedPoint& followed, const Vector3& x, double weight,
                            std::vector<Carrier>& carriers) const {
  Vector3 arm = minus(x, followed.at.x);
  if (followed.at.distance <= nothing * longest_edge(*followed.facet)) arm = {0, 0, 0};
  const bool facet_turns = turns(*followed.facet);
  for (std::size_t i = 0; i < followed.facet->corners().size(); ++i) {
    Carrier& carrier = carrier_of(followed.facet->nodes[i], carriers);
    for (std::size_t j = 0; j < 3; ++j) {
      Vector3 unit{0, 0, 0};
      unit[j] = weight;
      const double share = followed.at.shares[i];
      carrier.block[6 * j + j] += share * weight;
      const Vector3 turn = facet_turns ? Vector3{share * unit[0], share * unit[1], share * unit[2]}
                                       : turn_of(followed.at, i, unit);
      const Vector3 shift = cross(turn, arm);
      const std::size_t column = facet_turns ? 3 + j : j;
      for (std::size_t d = 0; d < 3; ++d) {
        carrier.block[6 * d + column] += shift[d];
        carrier.block[6 * (3 + d) + column] += turn[d];
      }
    }
  }
  if (facet_turns) add_bulges(followed, weight, carriers);
}

void FollowedFacets::find_bending() {
  std::map<std::pair<GlobalIndex, GlobalIndex>, Bending*> bending;
  for (const Facet& facet : facets_) {
    if (facet.count == 2 && turns(facet)) {
      bending[std::minmax(facet.nodes[0], facet.nodes[1])] = &bending_[&facet];
    }
  }
  for (const ElementSet& set : mesh_.regions) {
    const std::size_t width = element_layout(set.type).nodes;
    if (bending.empty() || !(is_beam(set.type) || is_shell(set.type))) continue;
    for (std::size_t first = 0; first < set.connectivity.size(); first += width) {
      const GlobalIndex* const nodes = &set.connectivity[first];
      for (std::size_t a = 0; a < width; ++a) {
        const auto found = bending.find(std::minmax(nodes[a], nodes[(a + 1) % width]));
        if (found == bending.end()) continue;
        if (is_beam(set.type)) found->second->beam = true;
        if (is_shell(set.type)) found->second->normals.push_back(normal_of(nodes, width));
      }
    }
  }
}

Vector3 FollowedFacets::normal_of(const GlobalIndex* nodes, std::size_t width) const {
  const Vector3 x = mesh_.position(nodes[0]);
  return normalised(
      cross(minus(mesh_.position(nodes[1]), x), minus(mesh_.position(nodes[width - 1]), x)));
}

Vector3 FollowedFacets::bent(const FollowedPoint& followed, const Vector3& bulge) const {
  constexpr double parallel = 0.99;
  Vector3 normal = followed.at.normal;
  if (followed.facet->count == 2) {
    const Bending& bending = bending_.at(followed.facet);
    if (bending.beam) return bulge;
    if (bending.normals.empty()) return {0, 0, 0};
    normal = bending.normals.front();
    if (std::ranges::any_of(bending.normals, [&](const Vector3& other) {
          return std::abs(dot(normal, other)) < parallel;
        })) {
      return bulge;
    }
  }
  const double out = dot(normal, bulge);
  return {out * normal[0], out * normal[1], out * normal[2]};
}

/// How far the edges of a facet that turns bend beside their chords.
void FollowedFacets::add_bulges(const FollowedPoint& followed, double weight,
                                std::vector<Carrier>& carriers) const {
  const auto corners = followed.facet->corners();
  const std::size_t edges = corners.size() == 2 ? 1 : corners.size();
  for (std::size_t i = 0; i < edges; ++i) {
    const double bulge = weight * followed.at.bulges[i] / 8;
    if (bulge == 0) continue;
    const GlobalIndex from = corners[i];
    const GlobalIndex to = corners[(i + 1) % corners.size()];
    const Vector3 edge = minus(mesh_.position(to), mesh_.position(from));
    for (const GlobalIndex corner : {from, to}) {
      Carrier& carrier = carrier_of(corner, carriers);
      for (std::size_t j = 0; j < 3; ++j) {
        Vector3 turn{0, 0, 0};
        turn[j] = corner == from ? bulge : -bulge;
        const Vector3 shift = bent(followed, cross(turn, edge));
        for (std::size_t d = 0; d < 3; ++d) carrier.block[6 * d + 3 + j] += shift[d];
      }
    }
  }
}

}  // namespace pounding
