#pragma once

#include <array>
#include <unordered_map>
#include <vector>

#include "common/matrix3.h"
#include "mesh/global_mesh.h"
#include "scene/scene.h"

/// Straight members of the beams of a mesh, each of which bends as one between the places where it
/// is held or joined. Serial, on a whole mesh.
namespace pounding {

/// A beam element with its local axes x, y, z as rows.
struct BeamPiece {
  std::array<GlobalIndex, 2> nodes{};
  const Region* region = nullptr;
  Matrix3 axes{};
  double length = 0;    ///< [m]
  bool is_rib = false;  ///< an edge of a shell element

  /// Bending stiffness E I about an axis across the beam (unit vector) [N m2].
  double bending(const Vector3& axis) const;
  /// Shear stiffness G A of the whole section [N].
  double shear() const;
  /// Mass with that spread over its length [kg].
  double mass() const;
};

/// Beams in one line from end to end; `nodes` has one more than `beams`.
struct BeamChain {
  std::vector<int> beams;
  std::vector<GlobalIndex> nodes;
  double length = 0;  ///< [m]
};

/// The beams of a structure in chains that run through nodes where nothing else joins them but
/// springs, point masses and arms with a free end. Edges of shells (ribs) run through shells and
/// each other.
class BeamChains {
 public:
  BeamChains(const Structure& structure, const GlobalMesh& mesh);

  const std::vector<BeamChain>& chains() const { return chains_; }
  const BeamPiece& beam(int number) const { return beams_[number]; }
  /// Whether nothing but one chain, its springs and its masses is at the node.
  bool is_free_end(GlobalIndex node, const BeamChain& chain) const;
  /// Stiffness against turning about an axis (unit vector) that all but the beams in line with a
  /// chain give to the node at its end; infinite where it is held [N m].
  double turning_stiffness(GlobalIndex node, const BeamChain& chain, const Vector3& axis) const;
  /// Sum of the point masses at a node [kg].
  double point_mass(GlobalIndex node) const { return joints_.at(node).mass; }
  /// Whether clamps hold a displacement along, or a rotation about, an axis (unit vector).
  bool is_clamped_along(GlobalIndex node, const Vector3& axis) const;
  bool is_clamped_about(GlobalIndex node, const Vector3& axis) const;
  /// Whether a rigid body or a tie turns the node with others about the axis.
  bool is_in_body(GlobalIndex node, const Vector3& axis) const;

 private:
  void collect(const Structure& structure);
  void add_beams(const Region& region, const ElementSet& set);
  void find_ribs(const ElementSet& set);
  void trace();
  int next(GlobalIndex node, int beam) const;
  void extend(GlobalIndex node, int beam, BeamChain& chain, std::vector<bool>& used) const;
  Vector3 direction_from(GlobalIndex node, int beam) const;

  struct Joint {
    std::vector<int> beams;
    bool joined = false;             ///< to a solid or bar
    bool on_shell = false;           ///< whose rotations it shares
    double mass = 0;                 ///< of point masses [kg]
    std::uint8_t in_bodies = 0;      ///< components that rigid bodies and ties hold
    std::array<double, 3> spring{};  ///< of springs about x, y, z [N m]
  };

  const GlobalMesh& mesh_;
  std::vector<BeamPiece> beams_;
  std::unordered_map<GlobalIndex, Joint> joints_;
  std::vector<BeamChain> chains_;
  std::vector<int> chain_of_;  ///< of each beam
  std::vector<bool> is_arm_;   ///< beams of chains with a free end at a joint of others
};

}  // namespace pounding
