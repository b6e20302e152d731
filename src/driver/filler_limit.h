#pragma once

#include <mpi.h>

#include "driver/model.h"
#include "scene/scene.h"

namespace pounding {

/// Stable time step [s] of a scene whose joints have fillers, all at their stiffest; infinite
/// without fillers. With k the stiffness of each pair, and H_s the part of structure s in H = L
/// M^-1 L^T, the step is stable where
///
///     sum_s  dt^2/4 eta_s / mu_s(dt)  <=  1,      eta_s = lambda_max( k^1/2 H_s k^1/2 )
///
/// with mu_s(dt) the smallest eigenvalue of M^-1 (M - dt/2 C - dt^2/4 K) of the structure: then
/// dt^2/4 L^T k L takes no more than that from any motion. Exact for masses on springs; on the safe
/// side else, by little where the filler is soft beside the structures' fastest motions. Structures
/// of more than one damping have mu_s >= 1 - dt / their stable step. `meshes`: those of the model's
/// structures. Collective over `comm`.
double filler_limit(MPI_Comm comm, const Scene& scene, const Model& model,
                    std::span<const Mesh> meshes);

}  // namespace pounding
