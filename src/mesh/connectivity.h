#pragma once

#include <utility>
#include <vector>

#include "common/types.h"
#include "mesh/global_mesh.h"
#include "scene/scene.h"

/// How the elements of one structure hang together, which a mesh that looks right may hide.
namespace pounding {

/// Nodes that elements join, directly or through others.
struct Piece {
  GlobalIndex nodes = 0;
  bool held = false;       ///< a node of it is clamped in some component, on a grounded spring, or
                           ///< on an absorbing face
  Vector3 place{0, 0, 0};  ///< of its first node [m]
  int rigid_motions = 0;   ///< that it can make: 6, or fewer if its nodes see fewer
  int held_motions = 0;    ///< of them, those that clamps and grounded springs prevent
};

/// A number of places of one kind, and the first of them.
struct Places {
  GlobalIndex count = 0;
  Vector3 first{0, 0, 0};  ///< [m]

  void add(const Vector3& place) {
    if (count++ == 0) first = place;
  }
};

struct Connectivity {
  std::vector<Piece> pieces;  ///< the largest first
  /// Pairs of nodes closer than `coincidence` of the mesh's diagonal that no element joins and that
  /// are not both clamped altogether, in one piece or in two.
  Places coincident_inside;
  Places coincident_apart;
  /// Free ends of lines that lie in another element without a node of it.
  Places ends_inside;
  /// Nodes of solids at which beams or shells may turn freely, and those of them where it is one
  /// beam alone.
  Places hinges;
  Places lone_hinges;

  GlobalIndex loose_pieces() const;
  bool nothing_held() const { return loose_pieces() == std::ssize(pieces); }
  /// Every rigid motion of every piece is prevented.
  bool wholly_held() const;
  /// The largest piece that nothing holds; there must be one.
  const Piece& loose_piece() const;

  static void members(auto& self, auto& stream) {
    stream(self.pieces, self.coincident_inside, self.coincident_apart, self.ends_inside,
           self.hinges, self.lone_hinges);
  }
};

inline constexpr double coincidence = 1e-6;  ///< of the diagonal of a structure's mesh

/// Examines a whole mesh. Serial; in time proportional to its size.
Connectivity examine_connectivity(const Structure& structure, const GlobalMesh& mesh);

/// Pairs of nodes (the lower number first, in increasing order) at most `near` > 0 [m] apart,
/// found in cells of a grid. Serial.
std::vector<std::pair<GlobalIndex, GlobalIndex>> near_nodes(const GlobalMesh& mesh, double near);

}  // namespace pounding
