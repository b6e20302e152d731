#pragma once

#include <span>

#include "interactions/pairing/interface.h"
#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding::interactions {

/// Finds the pairs of every contact of the scene: for each node of the secondary group the facet of
/// the primary group that the normal through the node meets; weights are the facet's shape
/// functions there, one node alone where it meets a node (matched). `meshes` in the order of the
/// scene's structures. A facet is met only if its outward normal looks against that of the node,
/// and behind the node, where bodies overlap, only within the elements behind the node. The gap is
/// that between surfaces: half of the thickness of shells is off on either side, but for edges in
/// the plane of their shell. Serial, rank 0. Throws UserError as find_sides does, for no pair at
/// all, and as check_contact does.
Interface find_interface(const Scene& scene, std::span<const GlobalMesh> meshes);

}  // namespace pounding::interactions
