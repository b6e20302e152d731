#pragma once

#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "interactions/pairing/contact_face.h"
#include "interactions/pairing/contact_sides.h"
#include "interactions/pairing/interface.h"

namespace pounding::interactions {

/// Where two edges of two nodes each pass each other.
struct Crossing {
  double first = 0;   ///< place on the first edge, 0 at its first node, 1 at its second
  double second = 0;  ///< on the second edge
  double gap = 0;     ///< from the first to the second along the direction [m]
};

/// Crossing of two edges seen along a unit vector, or nothing where they pass beside each other or
/// run alongside (sine of the angle between them below 0.1). Places within a relative 1e-6 of an
/// end are the end.
std::optional<Crossing> cross_edges(const GlobalMesh& first_mesh, const Facet& first,
                                    const GlobalMesh& second_mesh, const Facet& second,
                                    const Vector3& direction);

/// A facet that a node faces.
struct FacedFacet {
  std::size_t facet = 0;    ///< of the face
  FacetIntersection point;  ///< where the normal through the node meets it
  double gap = 0;           ///< between the surfaces: without the parts of shells beyond both [m]
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

/// Area that the facets of a side have in common with those of the other one that look against
/// them, seen along their normals: shares of the side's nodes in it, integrals of their shape
/// functions, in the order of its nodes [m2]. What lies over several facets counts once; facets
/// that lie deeper behind than the elements there have nothing in common. `finder` of the other
/// side; neither side holds lines.
std::vector<double> common_area(const FaceSide& side, const FaceSide& other,
                                const FacetFinder& finder);

/// Gathers the rows of one contact whose pairs are found anew: nodes of one side and the facets of
/// the other that each may come to face. Serial, rank 0.
class SlidingBuilder {
 public:
  /// References must outlive this object; `faces` is added to. `number`: index of the contact.
  /// Throws UserError where facets are edges.
  SlidingBuilder(const Contact& contact, int number, const FaceSide& nodes, const FaceSide& facets,
                 const FacetFinder& finder, SlidingFaces& faces);

  /// Some facet is within reach of node `i` of the face.
  bool may_face(std::size_t i) const;
  /// Node `i` of the face belongs to the last constraint.
  void add_row(std::size_t i, std::span<const Constraint> constraints);

 private:
  std::vector<std::size_t> within_reach(std::size_t i) const;
  int facet_number(std::size_t facet);
  int node_number(const FaceSide& side, GlobalIndex node);

  double reach_;
  int contact_;
  const FaceSide& side_;
  const FaceSide& other_;
  const FacetFinder& finder_;
  SlidingFaces& faces_;
  std::vector<int> facets_;                           ///< per facet: its number; -1: none yet
  std::map<std::pair<int, GlobalIndex>, int> nodes_;  ///< structure and node: its number
};

}  // namespace pounding::interactions
