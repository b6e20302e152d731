#pragma once

#include <map>
#include <vector>

#include "mesh/facet_point.h"
#include "mesh/global_mesh.h"

namespace pounding {

/// A facet that may be followed, and where.
struct FollowedPoint {
  const Facet* facet = nullptr;
  FacetPoint at;
};

/// Points of a facet's corners [m].
std::vector<Vector3> corners_of(const GlobalMesh& mesh, const Facet& facet);

/// Facets that nodes of a tie follow, and their motion at a point: see add_tied_nodes. Serial; mesh
/// and facets must outlive it.
class FollowedFacets {
 public:
  FollowedFacets(const GlobalMesh& mesh, const std::vector<Facet>& facets);

  const std::vector<Facet>& all() const { return facets_; }
  double longest_edge(const Facet& facet) const;  ///< [m]
  /// Whether all corners have rotations.
  bool turns(const Facet& facet) const;
  /// Distance up to which a facet is followed [m].
  double reach(const Facet& facet) const;

  /// The facet that is nearest to a point, and those that meet it at the point that is nearest.
  std::vector<FollowedPoint> nearest(const Vector3& x) const;
  /// Facets whose boxes come as near to a box as they are followed at most.
  std::vector<const Facet*> near(const BoundingBox& box) const;

  /// Adds `weight` times the motion of a facet at x to the blocks of a node's carriers, rows of
  /// rotations as well.
  void follow(const FollowedPoint& followed, const Vector3& x, double weight,
              std::vector<Carrier>& carriers) const;
  /// Part of a bulge that is followed: beams bend in every direction, shells out of their planes.
  Vector3 bent(const FollowedPoint& followed, const Vector3& bulge) const;

 private:
  /// Elements that bend along a line.
  struct Bending {
    bool beam = false;
    std::vector<Vector3> normals;  ///< of shells
  };
  void find_bending();
  Vector3 normal_of(const GlobalIndex* nodes, std::size_t width) const;
  void add_bulges(const FollowedPoint& followed, double weight,
                  std::vector<Carrier>& carriers) const;

  const GlobalMesh& mesh_;
  const std::vector<Facet>& facets_;
  std::vector<BoundingBox> boxes_;           ///< of the facets
  std::vector<double> reaches_;              ///< of the facets: farthest distance that follows [m]
  std::map<const Facet*, Bending> bending_;  ///< of lines that turn
};

/// The carrier of a node among those of a tied one, made if there is none.
Carrier& carrier_of(GlobalIndex node, std::vector<Carrier>& carriers);

/// Box of some points.
BoundingBox box_of(const std::vector<Vector3>& points);

}  // namespace pounding
