#pragma once

#include <span>
#include <string>
#include <vector>

#include "mesh/global_mesh.h"
#include "mesh/nodal_load.h"
#include "scene/scene.h"

namespace pounding {

/// Forces on nodes of every load of the scene, its history being 1. Forces per length, area and
/// volume go to the nodes by the integrals of their shape functions; forces per length on beams
/// come with the moments of a beam whose ends are held, q h^2 / 12, so that statics is exact at the
/// nodes. Throws UserError: a group that the mesh has not, one without lines, surfaces or volumes
/// to act on, a moment on nodes without rotations, a pressure on a face between two solids. Serial,
/// rank 0.
std::vector<NodalLoad> find_loads(const Scene& scene, std::span<const GlobalMesh> meshes);

/// Doubts about them, one line each: a load that acts on held components only, one whose forces
/// cancel out. Serial, rank 0.
std::vector<std::string> load_doubts(const Scene& scene, std::span<const GlobalMesh> meshes,
                                     std::span<const NodalLoad> loads);

}  // namespace pounding
