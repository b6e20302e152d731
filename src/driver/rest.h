#pragma once

#include <string>
#include <vector>

#include <mpi.h>

#include "common/profile.h"
#include "driver/model.h"
#include "scene/scene.h"

namespace pounding {

/// Lets the systems of a model start from their static equilibrium, where the scene asks for it,
/// and keeps what was found. Collective.
void put_at_rest(MPI_Comm comm, const Scene& scene, Profile& profile, Model& model);

/// Doubts about an equilibrium: settlements that small displacements do not describe, and forces
/// that do not sum up to the weight.
std::vector<std::string> rest_warnings(const Model& model);

/// Load of one contact at rest.
struct ContactLoad {
  int points = 0;    ///< of its pairs
  int closed = 0;    ///< of them, those that carry
  double force = 0;  ///< [N]
};

/// Loads of all contacts of a model that starts at rest.
std::vector<ContactLoad> contact_loads(const Scene& scene, const Model& model);

/// Prints what holds the scene at rest, nothing where it does not start there. Rank 0.
void print_rest(const Scene& scene, const Model& model);

}  // namespace pounding
