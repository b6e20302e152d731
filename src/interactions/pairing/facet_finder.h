#pragma once

#include <optional>
#include <vector>

#include "interactions/pairing/contact_face.h"

namespace pounding::interactions {

/// A facet that a node faces.
struct FacedFacet {
  std::size_t facet = 0;  ///< of the face
  FacetPoint point;       ///< where the normal through the node meets it
  double gap = 0;         ///< between the surfaces: without the parts of shells beyond both [m]
};

/// Finds the facets of a face that nodes face; bounding boxes of the facets across the normal let
/// it meet few of them in earnest.
class FacetFinder {
 public:
  /// `mesh` and `face` must outlive this object. `reach`: see meet_facet [m].
  FacetFinder(const GlobalMesh& mesh, const ContactFace& face, double reach);

  /// Facet that a node may face along its outward normal.
  struct Result {
    std::optional<FacedFacet> faced;
    /// Where nothing is faced: the nearest facet that looks at the node from too far behind it, as
    /// a negative gap [m]; 0: there is none.
    double behind = 0;
  };

  /// The nearest facet on the line through `origin` along the unit vector `direction` that looks
  /// against it. It may lie behind the node, where bodies overlap, but no deeper than `depth`.
  /// `half_thickness`: how far the node's own shell reaches beyond it. [m]
  Result find(const Vector3& origin, const Vector3& direction, double half_thickness,
              double depth) const;

  /// Facets that look against `direction` and may come to lie before a node at `origin` that moves
  /// across the direction by up to `distance` [m].
  std::vector<std::size_t> within(const Vector3& origin, const Vector3& direction,
                                  double distance) const;

 private:
  bool looks_against(std::size_t facet, const Vector3& direction) const;
  /// A facet looks against the direction and may reach within `distance` across it of the line [m].
  bool may_meet(std::size_t facet, const Vector3& origin, const Vector3& direction,
                double distance) const;

  const GlobalMesh& mesh_;
  const ContactFace& face_;
  double reach_;
  std::vector<Vector3> centre_;
  std::vector<double> radius_;
  std::vector<Vector3> normal_;
};

}  // namespace pounding::interactions
