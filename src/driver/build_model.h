#pragma once

#include <span>

#include <mpi.h>

#include "common/profile.h"
#include "contact/find_interface.h"
#include "driver/model.h"
#include "scene/scene.h"

namespace pounding {

/// Reads, partitions, distributes and assembles; finds modes, omega_max and the time step. Soil
/// gets its foundation from the mesh, and the scene keeps it. The model borrows from the scene.
/// `stiffness_factors`: per structure, on the squared frequencies of a reduced one; `gap_shares`:
/// unless null, receives where the rows of the interface lie on their faces. Throws UserError on
/// every rank alike. Collective.
Model build_model(MPI_Comm comm, Scene& scene, std::span<const double> stiffness_factors,
                  Profile& profile, std::vector<GapShare>* gap_shares = nullptr);

/// The time step and their number, where `stable` is the stable step [s]. Throws UserError.
void choose_time_step(const Scene& scene, double stable, Model& model);

}  // namespace pounding
