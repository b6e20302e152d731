#pragma once

#include <optional>
#include <vector>

#include "mesh/global_mesh.h"

namespace pounding {

/// A physical group seen as one side of a contact: faces of solids, faces of shells, or edges of
/// shells, whose normal lies in the plane of the shell.
struct ContactFace {
  std::vector<GlobalIndex> nodes;     ///< file order
  std::vector<Vector3> node_normals;  ///< outward, unit, area-weighted mean of the facets around
  std::vector<Facet> facets;
  std::vector<Vector3> facet_normals;  ///< outward, unit
  Vector3 mean_normal{0, 0, 0};
  Vector3 centroid{0, 0, 0};  ///< mean of the nodes
  bool sided = true;          ///< false: both sides of a shell are outside
};

/// Builds a face from the facets of a group that solids or shells hold; outward is away from those
/// elements. Empty if there are none.
ContactFace build_contact_face(const GlobalMesh& mesh, const NodeGroup& group);

/// Turns all normals of a face that is not sided towards a point.
void turn_towards(ContactFace& face, const Vector3& point);

/// Where a line meets a facet.
struct FacetPoint {
  std::array<double, 4> weights{};  ///< shape functions of the facet's nodes there
  double distance = 0;              ///< along the line's direction from its origin [m]
};

/// The point where the line from `origin` along the unit vector `direction` meets a facet (bilinear
/// quadrilateral, triangle, or edge), or nothing if it passes outside by more than a relative
/// `tolerance`. An edge is met when the line passes it at no more than `reach` [m].
std::optional<FacetPoint> meet_facet(const GlobalMesh& mesh, const Facet& facet,
                                     const Vector3& origin, const Vector3& direction,
                                     double tolerance, double reach = 0);

double dot(const Vector3& a, const Vector3& b);
Vector3 cross(const Vector3& a, const Vector3& b);
Vector3 normalised(const Vector3& a);
Vector3 minus(const Vector3& a, const Vector3& b);

}  // namespace pounding
