#pragma once

#include <memory>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/nodal_load.h"
#include "system/linear_system.h"

namespace pounding {

/// Forces of one load on the owned dofs of a structure, its history being 1.
struct LoadShape {
  std::size_t load = 0;          ///< in the scene
  std::vector<LocalIndex> dofs;  ///< increasing
  std::vector<double> force;     ///< p on each of them [N, N m]; of coordinates Phi^T p
  double before_start = 0;       ///< f before the run, see LoadHistories [-]
  Vector3 total_force{0, 0, 0};  ///< of the whole load, held components included [N]
};

/// Loads of a structure beside gravity and the motion of the ground: f_l(t) p_l on its right-hand
/// side, with f_l the history of load l (see LoadHistories) and p_l its forces.
struct LoadShapes {
  std::vector<LoadShape> loads;

  /// Adds sum_l f_l p_l before the run to a field over the owned dofs [N, N m].
  void add_at_rest(std::vector<double>& force) const;
  /// Sum of the forces before the run, held components included [N].
  Vector3 total_at_rest() const;
};

/// Loads of the scene, found on its meshes.
struct SceneLoads {
  std::span<const NodalLoad> nodal;
  std::vector<double> before_start;  ///< f of each before the run [-]
};

/// Loads of structure `s` at full order, on this rank; null if no load of the scene acts on it.
/// Local.
std::shared_ptr<const LoadShapes> shape_loads(const SceneLoads& loads, int s, const Mesh& mesh);

/// Loads of structure `s` in generalised coordinates: `parts` is Phi^T p of its loads in their
/// order, shape (its loads, coordinates), read where `owner`; null if no load acts on it. Local.
std::shared_ptr<const LoadShapes> shape_reduced_loads(const SceneLoads& loads, int s,
                                                      std::span<const double> parts, bool owner);

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
