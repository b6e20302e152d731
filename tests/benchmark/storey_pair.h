#pragma once

#include <array>

#include "interactions/pairing/interface.h"
#include "mesh/global_mesh.h"

namespace pounding::measuring {

/// Two equal block-like buildings of three storeys that face each other across a gap: slabs 1 m
/// thick on four stout columns, clamped at the base, all bricks of one size. The edges of the slabs
/// face node to node.
struct StoreyPair {
  std::array<GlobalMesh, 2> meshes;   ///< regions: "body" of hex8
  interactions::Interface interface;  ///< one row per pair of facing nodes
};

/// `cells_per_metre`: bricks along one metre; the pair has about 600 times its cube dofs.
StoreyPair build_storey_pair(int cells_per_metre);

}  // namespace pounding::measuring
