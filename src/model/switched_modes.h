#pragma once

#include "model/model.h"
#include "scene/scene.h"

namespace pounding {

/// Most of its energy that a strike leaves in motions above the modes of a basis that is chosen, as
/// measured on plants with thin slabs [-].
inline constexpr double struck_part = 1e-2;

/// Most modes of such a basis; a shorter one waits longer after a strike.
inline constexpr int most_chosen_modes = 300;

/// Completes the request for the basis of a structure that is switched, and its system for that.
/// The cut-off, where neither it nor a number of modes is given: the lowest frequency above which
/// motions settle within a period of the first mode, as buildings that strike each other come back
/// about so often; of at most `most_chosen_modes`. Loads: behind those of the system the forces of
/// its links on each of its lowest modes, since the motion that these make outside the modes is
/// near to a static response to them. Collective.
void prepare_switched(const Mesh& mesh, LinearSystem& system, ModalRequest& request);

/// Gives structures that are switched their modes, out of the bases of the model, once their
/// systems are at rest. Throws UserError where dashpots follow supports. Collective.
void give_modes(MPI_Comm comm, const Scene& scene, Model& model);

/// Time in which free motion of a circular frequency, after a strike `struck_part` of the energy,
/// is damped to a smaller part of it [s].
double settling_time(const LinearSystem& system, double omega, double part);

}  // namespace pounding
