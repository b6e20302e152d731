#pragma once

#include <string>
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

/// Doubts about an equilibrium: settlements that small displacements do not describe, and forces
/// that do not sum up to the weight.
std::vector<std::string> rest_warnings(const Model& model);

/// Per row of the interface, whether its gap is that of the rest (Contact::gap_at_rest): it is open
/// there, whatever the rest is. Throws UserError, alike on all ranks, where the meshes overlap and
/// the gap of the rest is that of the meshes.
std::vector<char> rows_open_at_rest(const Scene& scene, const interactions::Interface& interface);

/// Gaps at the start of a run: g0 + L u_0, where gaps of the rest make g0 = g - L u_0, row by row;
/// of the joints both. Once the equilibrium is known, if there is one.
void find_start_gaps(const Scene& scene, Model& model);

/// Doubts about gaps of the rest: a joint that its weight opens by more than it is wide.
std::vector<std::string> rest_gap_warnings(const Scene& scene, const Model& model);

}  // namespace pounding
