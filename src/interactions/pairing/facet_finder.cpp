#include "interactions/pairing/facet_finder.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "mesh/facet_overlap.h"
#include "mesh/followed_facets.h"

namespace pounding::interactions {
namespace {

/// Sine of an angle below which edges run alongside.
constexpr double alongside = 0.1;

/// A place this close to an end is the end, and this far beyond it still on the edge.
constexpr double at_end = 1e-6;

/// Snaps a place to the ends of its edge; nothing beyond them.
std::optional<double> onto_edge(double place) {
  if (place < -at_end || place > 1 + at_end) return std::nullopt;
  if (place < at_end) return 0;
  return place > 1 - at_end ? 1 : place;
}

/// A facet looks against a direction if the cosine of its outward normal is below this.
constexpr double facing_cosine = -0.5;

/// Integrals over some places of a facet.
struct Sums {
  double area = 0;
  Vector3 middle{0, 0, 0};
  std::array<double, 4> shares{};
};

Sums sums_of(const std::vector<OverlapPoint>& points) {
  Sums sums;
  for (const OverlapPoint& point : points) {
    sums.area += point.weight;
    for (std::size_t d = 0; d < 3; ++d) sums.middle[d] += point.weight * point.x[d];
    for (std::size_t a = 0; a < 4; ++a) sums.shares[a] += point.weight * point.shares[a];
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
    const Sums sums = sums_of(overlap_points(corners, corners_of(*other.mesh, faced)));
    if (!(sums.area > 0)) continue;
    const auto met = meet_facet(*other.mesh, faced, sums.middle, normal, facet_tolerance);
    const double depth = side.face.facet_depth[f] + facet_tolerance * radius;
    const double reach = side.face.facet_half_thickness[f] + other.face.facet_half_thickness[g];
    if (met && met->distance - reach < -depth) continue;
    all.area += sums.area;
    for (std::size_t a = 0; a < 4; ++a) all.shares[a] += sums.shares[a];
  }
  const double whole = sums_of(overlap_points(corners, corners)).area;
  for (double& share : all.shares) share *= all.area > whole ? whole / all.area : 1;
  return all.shares;
}

}  // namespace

std::optional<Crossing> cross_edges(const GlobalMesh& first_mesh, const Facet& first,
                                    const GlobalMesh& second_mesh, const Facet& second,
                                    const Vector3& direction) {
  const Vector3 a = minus(first_mesh.position(first.nodes[1]), first_mesh.position(first.nodes[0]));
  const Vector3 b =
      minus(second_mesh.position(second.nodes[1]), second_mesh.position(second.nodes[0]));
  const Vector3 to =
      minus(second_mesh.position(second.nodes[0]), first_mesh.position(first.nodes[0]));
  // s a - t b = to across the direction.
  const double area = dot(cross(a, b), direction);
  if (std::abs(area) < alongside * std::sqrt(dot(a, a) * dot(b, b))) return std::nullopt;
  const std::optional<double> s = onto_edge(dot(cross(to, b), direction) / area);
  const std::optional<double> t = onto_edge(dot(cross(to, a), direction) / area);
  if (!s || !t) return std::nullopt;
  return Crossing{*s, *t, dot(to, direction) + *t * dot(b, direction) - *s * dot(a, direction)};
}

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

SlidingBuilder::SlidingBuilder(const Contact& contact, int number, const FaceSide& nodes,
                               const FaceSide& facets, const FacetFinder& finder,
                               SlidingFaces& faces)
    : reach_(contact.sliding),
      contact_(number),
      side_(nodes),
      other_(facets),
      finder_(finder),
      faces_(faces),
      facets_(facets.face.facets.size(), -1) {
  refuse_if(facets.face.has_lines(),
            "option -" + contact.name +
                "_sliding: pairs are found anew on facets of solids and shells, and a face of "
                "this contact has edges or axes of beams; leave it out");
}

std::vector<std::size_t> SlidingBuilder::within_reach(std::size_t i) const {
  return finder_.within(side_.mesh->position(side_.face.nodes[i]), side_.face.node_normals[i],
                        reach_);
}

bool SlidingBuilder::may_face(std::size_t i) const {
  return !within_reach(i).empty();
}

int SlidingBuilder::node_number(const FaceSide& side, GlobalIndex node) {
  const auto [found, fresh] =
      nodes_.try_emplace({side.structure, node}, static_cast<int>(faces_.nodes.size()));
  if (fresh) faces_.nodes.push_back({side.structure, node, side.mesh->position(node)});
  return found->second;
}

int SlidingBuilder::facet_number(std::size_t facet) {
  if (facets_[facet] >= 0) return facets_[facet];
  SlidingFaces::Facet entry;
  for (const GlobalIndex node : other_.face.facets[facet].corners()) {
    entry.nodes[static_cast<std::size_t>(entry.count++)] = node_number(other_, node);
  }
  entry.half_thickness = other_.face.facet_half_thickness[facet];
  entry.size = other_.face.facet_size(facet);
  facets_[facet] = static_cast<int>(faces_.facets.size());
  faces_.facets.push_back(entry);
  return facets_[facet];
}

void SlidingBuilder::add_row(std::size_t i, std::span<const Constraint> constraints) {
  SlidingFaces::Row row;
  row.constraint = static_cast<int>(constraints.size()) - 1;
  row.contact = contact_;
  row.node = node_number(side_, side_.face.nodes[i]);
  row.normal = side_.face.node_normals[i];
  row.half_thickness = side_.face.node_half_thickness[i];
  row.depth = side_.face.node_depth[i];
  row.first = static_cast<int>(faces_.candidates.size());
  for (const std::size_t facet : within_reach(i)) {
    faces_.candidates.push_back(facet_number(facet));
  }
  row.end = static_cast<int>(faces_.candidates.size());
  faces_.rows.push_back(row);
}

}  // namespace pounding::interactions
