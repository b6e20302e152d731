#include "interactions/pairing/facet_finder.h"

#include <algorithm>
#include <cmath>

#include "interactions/pairing/pair_terms.h"

namespace pounding::interactions {
namespace {

/// A facet looks against a direction if the cosine of its outward normal is below this.
constexpr double facing_cosine = -0.5;

}  // namespace

FacetFinder::FacetFinder(const GlobalMesh& mesh, const ContactFace& face, double reach)
    : mesh_(mesh), face_(face), reach_(reach) {
  for (const Facet& facet : face.facets) {
    Vector3 low = mesh.position(facet.nodes[0]);
    Vector3 high = low;
    for (const GlobalIndex node : facet.corners()) {
      const Vector3 x = mesh.position(node);
      for (std::size_t d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], x[d]);
        high[d] = std::max(high[d], x[d]);
      }
    }
    radius_.push_back(std::sqrt(dot(minus(high, low), minus(high, low))) / 2);
    centre_.push_back({(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2});
  }
  std::ranges::transform(face.facet_areas, std::back_inserter(normal_), normalised);
}

bool FacetFinder::looks_against(std::size_t facet, const Vector3& direction) const {
  const double cosine = dot(normal_[facet], direction);
  return (face_.two_sided[facet] != 0 ? -std::abs(cosine) : cosine) < facing_cosine;
}

bool FacetFinder::may_meet(std::size_t facet, const Vector3& origin, const Vector3& direction,
                           double distance) const {
  const Vector3 to = minus(centre_[facet], origin);
  const double along = dot(to, direction);
  const double across = std::sqrt(std::max(0.0, dot(to, to) - along * along));
  return across <= 1.01 * radius_[facet] + distance && looks_against(facet, direction);
}

FacetFinder::Result FacetFinder::find(const Vector3& origin, const Vector3& direction,
                                      double half_thickness, double depth) const {
  Result result;
  for (std::size_t f = 0; f < face_.facets.size(); ++f) {
    if (!may_meet(f, origin, direction, reach_)) continue;
    const auto point =
        meet_facet(mesh_, face_.facets[f], origin, direction, facet_tolerance, reach_);
    if (!point) continue;
    const double gap = point->distance - half_thickness - face_.facet_half_thickness[f];
    const double margin = 1e-9 * radius_[f];
    if (gap < -depth - facet_tolerance * radius_[f]) {
      result.behind = result.behind < 0 ? std::max(result.behind, gap) : gap;
    } else if (!result.faced || std::abs(gap) < std::abs(result.faced->gap) - margin) {
      result.faced = {f, *point, gap};
    }
  }
  return result;
}

std::vector<std::size_t> FacetFinder::within(const Vector3& origin, const Vector3& direction,
                                             double distance) const {
  std::vector<std::size_t> facets;
  for (std::size_t f = 0; f < face_.facets.size(); ++f) {
    if (may_meet(f, origin, direction, distance)) facets.push_back(f);
  }
  return facets;
}

}  // namespace pounding::interactions
