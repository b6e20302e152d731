#pragma once

#include <string>
#include <vector>

#include <mpi.h>

#include "modal/modal_basis.h"
#include "model/model.h"
#include "motion/load_histories.h"
#include "scene/scene.h"
#include "stability/resolved_motion.h"

namespace pounding {

struct Building;
struct Model;

/// The fastest motion that a structure is asked to resolve: spectra end at `last` [Hz].
ResolvedMotion resolved_motion_of(const Building& building, double last);

/// The motion that a step resolves of a reduced structure with these squared frequencies.
ResolvedMotion resolved_motion_of(const Structure& structure, const ModalBasis& basis, double last);

/// Limits of all structures and fillers of a model together.
StepLimits step_limits(const Scene& scene, const Model& model);

/// Narrows limits by the histories of loads.
void limit_by_loads(const Scene& scene, const LoadHistories* histories, StepLimits& limits);

/// Narrows limits to those of fillers whose stable time step is `stable` [s]; `last`: see above.
void limit_by_fillers(double stable, double last, StepLimits& limits);

/// The time step and the number of steps under these limits. Throws UserError.
void choose_time_step(const Scene& scene, const StepLimits& limits, Model& model);

/// Source of the time step in force, in words: "set by the stable one, -courant 0.9".
std::string step_source_text(const Scene& scene, const Model& model);

/// The step that versions took which did not ask for its resolution [s].
double earlier_time_step(const Scene& scene, const Model& model);

/// A line if a step that was given does not resolve the motion that the limits name.
std::vector<std::string> long_step_warnings(const Scene& scene, const Model& model);

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
