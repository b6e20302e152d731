#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "common/matrix3.h"
#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding::interactions {

/// The part of a vector across a unit vector.
inline Vector3 part_across(const Vector3& v, const Vector3& normal) {
  const double along = dot(v, normal);
  return {v[0] - along * normal[0], v[1] - along * normal[1], v[2] - along * normal[2]};
}

/// A physical group seen as one side of a contact: faces of solids, faces of shells, edges of
/// shells, whose normal lies in the plane of the shell, or axes of beams, which look wherever they
/// are asked to.
struct ContactFace {
  std::vector<GlobalIndex> nodes;     ///< file order
  std::vector<Vector3> node_normals;  ///< outward, unit, area-weighted mean of the facets around
  std::vector<double> node_half_thickness;  ///< how far shells reach beyond the node: largest of
                                            ///< the facets around [m]
  std::vector<double> node_depth;           ///< of the elements behind it, see Backing::depth [m]
  std::vector<Facet> facets;
  std::vector<Vector3> facet_areas;          ///< twice the area (length for an edge) along the
                                             ///< outward normal
  std::vector<char> two_sided;               ///< per facet: both sides of a shell are outside
  std::vector<double> facet_half_thickness;  ///< as of the nodes [m]
  std::vector<double> facet_half_width;  ///< of edges half the thickness of their shell, else 0 [m]
  std::vector<double> facet_depth;       ///< as of the nodes [m]
  Vector3 mean_normal{0, 0, 0};
  Vector3 centroid{0, 0, 0};  ///< mean of the nodes
  /// Every facet is an edge of a shell or the axis of a beam.
  bool is_line() const {
    return std::ranges::all_of(facets, [](const Facet& facet) { return facet.count == 2; });
  }
  /// Some facet is.
  bool has_lines() const {
    return std::ranges::any_of(facets, [](const Facet& facet) { return facet.count == 2; });
  }
  /// Area of a facet [m2], of an edge its length [m].
  double facet_area(std::size_t facet) const {
    return norm(facet_areas[facet]) / (facets[facet].count == 2 ? 1 : 2);
  }
  /// Side of a square of a facet's area, of an edge its length [m].
  double facet_size(std::size_t facet) const {
    const double area = facet_area(facet);
    return facets[facet].count == 2 ? area : std::sqrt(area);
  }
  double mean_facet_size() const;
  int beams = 0;         ///< facets that are axes of beams
  int inner_facets = 0;  ///< with elements on both of their sides
  /// Unit normals among which nothing chose, of facets that are left out: see build_contact_face.
  std::vector<Vector3> undecided;
};

/// Builds a face from the facets of a group that solids or shells hold; outward is away from those
/// elements. Empty if there are none. A facet may hold to several elements, as the edge of a floor
/// that ends at a wall: then that one lies behind it whose normal is closest to `towards`; without
/// that direction such facets are left out, and their normals listed; axes of beams likewise, with
/// the global axes across them. `regions` of the structure.
ContactFace build_contact_face(const GlobalMesh& mesh, std::span<const Region> regions,
                               const NodeGroup& group,
                               const std::optional<Vector3>& towards = std::nullopt);

/// Turns the normals of facets that are two-sided towards a point, all of them together.
void turn_towards(ContactFace& face, const Vector3& point);

/// Where a line meets a facet.
struct FacetIntersection {
  std::array<double, 4> weights{};  ///< shape functions of the facet's nodes there
  double distance = 0;              ///< along the line's direction from its origin [m]
};

/// The point where the line from `origin` along the unit vector `direction` meets the bilinear
/// quadrilateral or the triangle of some corners, or nothing if it passes outside by more than a
/// relative `tolerance`.
std::optional<FacetIntersection> meet_corners(std::span<const Vector3> corners,
                                              const Vector3& origin, const Vector3& direction,
                                              double tolerance);

/// The point where the line from `origin` along the unit vector `direction` meets a facet (bilinear
/// quadrilateral, triangle, or edge), or nothing if it passes outside by more than a relative
/// `tolerance`. An edge is met when the line passes it at no more than `reach` [m].
std::optional<FacetIntersection> meet_facet(const GlobalMesh& mesh, const Facet& facet,
                                            const Vector3& origin, const Vector3& direction,
                                            double tolerance, double reach = 0);

/// Nodes of a face that ties let follow none but other nodes of it: what these carry in contact
/// holds them too, so that rows of both would share it in no unique way. `has_row`: per node of the
/// face, whether it faces something. Carriers that are clamped altogether need no row. One value
/// per node of the face, 1 for those; serial.
std::vector<char> carried_nodes(const GlobalMesh& mesh, const ContactFace& face,
                                const std::vector<char>& has_row);

}  // namespace pounding::interactions
