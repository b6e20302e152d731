#pragma once

#include <vector>

#include <mpi.h>

#include "common/profile.h"
#include "model/model.h"
#include "scene/scene.h"

namespace pounding {

/// Lets the systems of a model start from their static equilibrium, where the scene asks for it,
/// and keeps its results. `meshes`: those of its structures. Collective.
void put_at_rest(MPI_Comm comm, const Scene& scene, std::span<const Mesh> meshes, Profile& profile,
                 Model& model);

/// Overlap that round-off may make of a joint that is just closed, over the model's longest side.
inline constexpr double none_below = 1e-9;

/// Per row of the interface, whether its gap is that of the rest (Contact::gap_at_rest): it is open
/// there, whatever the rest is. Throws UserError, alike on all ranks, where the meshes overlap and
/// the gap of the rest is that of the meshes.
std::vector<char> rows_open_at_rest(const Scene& scene, const interactions::Interface& interface);

/// Gaps at the start of a run: g0 + L u_0, where gaps of the rest make g0 = g - L u_0, row by row;
/// of the joints both. Once the equilibrium is known, if there is one.
void find_start_gaps(const Scene& scene, Model& model);

}  // namespace pounding
