#pragma once

#include <optional>
#include <vector>

#include "mesh/global_mesh.h"

namespace pounding {

/// A physical group seen as one side of a contact.
struct ContactFace {
  std::vector<GlobalIndex> nodes;     ///< file order
  std::vector<Vector3> node_normals;  ///< outward, unit, area-weighted mean of the facets around
  std::vector<Facet> facets;
  std::vector<Vector3> facet_normals;  ///< outward, unit
  Vector3 mean_normal{0, 0, 0};
};

/// Builds a face from the surface facets of a group; outward is away from the elements that hold
/// the facet. Empty if the group has no surface facets.
ContactFace build_contact_face(const GlobalMesh& mesh, const NodeGroup& group);

/// Where a line meets a facet.
struct FacetPoint {
  std::array<double, 4> weights{};  ///< shape functions of the facet's nodes there
  double distance = 0;              ///< along the line's direction from its origin [m]
};

/// The point where the line from `origin` along the unit vector `direction` meets a facet (bilinear
/// quadrilateral or triangle), or nothing if it passes outside by more than a relative `tolerance`.
std::optional<FacetPoint> meet_facet(const GlobalMesh& mesh, const Facet& facet,
                                     const Vector3& origin, const Vector3& direction,
                                     double tolerance);

double dot(const Vector3& a, const Vector3& b);
Vector3 cross(const Vector3& a, const Vector3& b);
Vector3 normalised(const Vector3& a);
Vector3 minus(const Vector3& a, const Vector3& b);

}  // namespace pounding
