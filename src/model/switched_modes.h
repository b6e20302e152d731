#pragma once

#include "model/model.h"
#include "scene/scene.h"

namespace pounding {

/// Completes the request for the basis of a structure that is switched, and its system for that.
/// The cut-off, where neither it nor a number of modes is given: the lowest frequency above which
/// motions fall to `switched_part` of their energy within a period of the first mode, as buildings
/// that strike each other come back about so often. Loads: behind those of the system the forces of
/// its dashpots on each of its lowest modes, since the motion that dashpots make outside the modes
/// is near to a static response to these. Collective.
void prepare_switched(const Mesh& mesh, LinearSystem& system, ModalRequest& request);

/// Gives structures that are switched their modes, out of the bases of the model, once their
/// systems are at rest. Throws UserError where dashpots follow supports. Collective.
void give_modes(MPI_Comm comm, const Scene& scene, Model& model);

/// Time in which free motion of a circular frequency is damped to a part of its energy [s].
double settling_time(const LinearSystem& system, double omega, double part);

}  // namespace pounding
