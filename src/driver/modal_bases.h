#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "common/profile.h"
#include "mesh/global_mesh.h"
#include "mesh/mesh.h"
#include "model/model.h"
#include "scene/scene.h"
#include "system/element_forces.h"
#include "system/linear_system.h"

namespace pounding {

/// Bases of the reduced structures of a scene into `model.buildings`: out of a structure's file if
/// that still belongs to it, else computed, several structures at a time, and written there. A
/// basis is computed by the rank alone that has all the structure, so that it has the same bits on
/// any number of ranks, unless the structure asks for several ranks. `meshes` are read on rank 0
/// only; the model has its meshes, contacts, probes, forces, loads and starts. Throws UserError on
/// every rank alike. Collective.
void find_bases(MPI_Comm comm, const Scene& scene, std::span<const GlobalMesh> meshes,
                Profile& profile, Model& model);

/// System of structure `s` of the scene at full order, whether a run steps it so or a basis is made
/// of it: on a mesh of it, with its loads and its start. `structure` may differ from the scene's in
/// its step. Collective over the ranks of the mesh.
LinearSystem assemble_structure(const Model& model, std::size_t s, const Structure& structure,
                                const Mesh& mesh, StiffnessMethod method, bool with_matrix);

/// Refuses matrices from files that give energy and columns that buckle under their axial forces.
/// Needs the matrix of the system. Throws UserError on every rank alike. Collective.
void require_stable(const Structure& structure, const Mesh& mesh, const LinearSystem& system,
                    const std::optional<LargestCompression>& compression);

/// How the system follows the supports of its structure, where these move on their own, and the
/// ends of its links with it. Needs its matrix. Collective.
void follow_supports(const Model& model, const Structure& structure, const Mesh& mesh,
                     SolverChoice solver, LinearSystem& system);

}  // namespace pounding
