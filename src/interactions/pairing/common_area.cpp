#include "interactions/pairing/common_area.h"

#include <algorithm>
#include <map>

#include "interactions/pairing/pair_terms.h"
#include "mesh/facet_overlap.h"
#include "mesh/followed_facets.h"

namespace pounding::interactions {
namespace {

/// Integrals over some places of a facet.
struct Sums {
  double area = 0;
  Vector3 middle{0, 0, 0};
  std::array<double, 4> shares{};
};

Sums sums_of(const std::vector<OverlapPlace>& places) {
  Sums sums;
  for (const OverlapPlace& place : places) {
    sums.area += place.weight;
    for (std::size_t d = 0; d < 3; ++d) sums.middle[d] += place.weight * place.place[d];
    for (std::size_t a = 0; a < 4; ++a) sums.shares[a] += place.weight * place.shares[a];
  }
  if (sums.area > 0) {
    for (double& x : sums.middle) x /= sums.area;
  }
  return sums;
}

/// Shares of a facet's corners in its area in common with the other side.
std::array<double, 4> shares_of(const FaceSide& side, std::size_t f, const FaceSide& other,
                                const FacetFinder& finder) {
  const Facet& facet = side.face.facets[f];
  const std::vector<Vector3> corners = corners_of(*side.mesh, facet);
  const Vector3 centre = centroid(*side.mesh, facet.corners());
  double radius = 0;
  for (const Vector3& corner : corners) radius = std::max(radius, norm(minus(corner, centre)));
  const Vector3 normal = normalised(side.face.facet_areas[f]);
  Sums all;
  for (const std::size_t g : finder.within(centre, normal, radius)) {
    const Facet& faced = other.face.facets[g];
    const Sums sums = sums_of(overlap_places(corners, corners_of(*other.mesh, faced)));
    if (!(sums.area > 0)) continue;
    const auto met = meet_facet(*other.mesh, faced, sums.middle, normal, facet_tolerance);
    const double depth = side.face.facet_depth[f] + facet_tolerance * radius;
    const double reach = side.face.facet_half_thickness[f] + other.face.facet_half_thickness[g];
    if (met && met->distance - reach < -depth) continue;
    all.area += sums.area;
    for (std::size_t a = 0; a < 4; ++a) all.shares[a] += sums.shares[a];
  }
  const double whole = sums_of(overlap_places(corners, corners)).area;
  for (double& share : all.shares) share *= all.area > whole ? whole / all.area : 1;
  return all.shares;
}

}  // namespace

std::vector<double> common_area(const FaceSide& side, const FaceSide& other,
                                const FacetFinder& finder) {
  std::map<GlobalIndex, double> of_node;
  for (std::size_t f = 0; f < side.face.facets.size(); ++f) {
    const std::array<double, 4> shares = shares_of(side, f, other, finder);
    const auto corners = side.face.facets[f].corners();
    for (std::size_t a = 0; a < corners.size(); ++a) of_node[corners[a]] += shares[a];
  }
  std::vector<double> areas;
  for (const GlobalIndex node : side.face.nodes) areas.push_back(of_node[node]);
  return areas;
}

}  // namespace pounding::interactions
