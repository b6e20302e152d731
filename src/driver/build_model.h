#pragma once

#include <functional>
#include <span>

#include <mpi.h>

#include "common/profile.h"
#include "interactions/pairing/find_interface.h"
#include "model/model.h"
#include "scene/scene.h"

namespace pounding {

/// Work on every rank once the faces in contact are known, before bases are computed. The reports
/// of the interface are on rank 0 only.
using ContactsKnown = std::function<void(const interactions::Interface&)>;

/// Reads, partitions, distributes and assembles; finds modes, omega_max and the time step. Soil
/// gets its foundation from the mesh, and the scene keeps it. The model borrows from the scene.
/// `stiffness_factors`: per structure, on the squared frequencies of a reduced one; `splits`: how
/// often every element is split, not of meshes cut before. Throws UserError on every rank alike,
/// and the errors of `contacts_known`. Collective.
Model build_model(MPI_Comm comm, Scene& scene, std::span<const double> stiffness_factors,
                  Profile& profile, const ContactsKnown& contacts_known = {}, int splits = 0);

}  // namespace pounding
