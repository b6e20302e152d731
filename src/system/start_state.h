#pragma once

#include <memory>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/nodal_load.h"
#include "system/linear_system.h"

namespace pounding {

/// State of a structure at t = 0 where its nodes start differently, over the owned dofs [m, rad],
/// [m/s, rad/s]; of coordinates M_q^-1 Phi^T M u.
struct StartState {
  std::vector<double> displacement;
  std::vector<double> velocity;
};

/// Start of a structure at full order: those of all its nodes, and of single ones. Null where none
/// differs. Throws UserError on every rank where the nodes of a rigid body or a tie are to start
/// otherwise than it moves. Collective.
std::shared_ptr<const StartState> shape_start(const NodalStart& start, const LinearSystem& system,
                                              const Mesh& mesh);

/// Start of a structure in generalised coordinates of masses `masses`: `parts` is Phi^T M of
/// displacement and velocity, shape (2, coordinates), read where `owner`; null where there are
/// none. Local.
std::shared_ptr<const StartState> shape_reduced_start(std::span<const double> parts,
                                                      std::span<const double> masses, bool owner);

}  // namespace pounding
