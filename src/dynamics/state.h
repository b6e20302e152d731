#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/petsc.h"
#include "common/saved_state.h"
#include "interactions/interaction.h"
#include "system/linear_system.h"

namespace pounding {

/// State of one structure, all that evolves; owned dofs of this rank. `Number`: double in one run,
/// BatchValue in eight. Before the step to t_n:
template <typename Number>
struct StateOf {
  std::vector<Number> displacement;             ///< u_n [m, rad]
  std::vector<Number> velocity;                 ///< v_{n-1/2} [m/s, rad/s]
  std::vector<Number> extra_force;              ///< of the extra damping in the step; empty without
  std::vector<Number> inelastic_force;          ///< of elements in the step; empty without
  std::vector<std::vector<Number>> filtered{};  ///< Z_i by filter, last (1 - s) K u_0 [N, N m]
};
using StructureState = StateOf<double>;

/// Displacement and velocity of a structure as PETSc vectors over its ranks, with the layout of its
/// mesh, on the very arrays of its state: PETSc's norms, viewers and a user's own code see them.
/// The step writes the arrays past PETSc, so a vector is asked for anew in each step.
class StateVectors {
 public:
  StateVectors() = default;
  /// The arrays of `state` must keep their place as long as this object lives. Collective.
  StateVectors(const LinearSystem& system, StructureState& state);
  Vec displacement() const { return renewed(displacement_.get()); }  ///< u_n; borrowed
  Vec velocity() const { return renewed(velocity_.get()); }          ///< v_{n-1/2}; borrowed

 private:
  /// Tells PETSc that the values are new, so that it keeps no norm of the old ones.
  static Vec renewed(Vec vector);

  VecHandle displacement_;
  VecHandle velocity_;
};

struct State {
  std::vector<StructureState> structures;
  interactions::SupportState supports;
  std::int64_t step = 0;  ///< n of the next step

  /// Starts at rest but for the initial displacement and velocity of every structure.
  /// `support_columns`: number of components of the supports' motion.
  explicit State(std::span<const LinearSystem> systems, std::size_t support_columns = 0);

  void keep(const StateKeeper& state);
};

/// K w of the owned dofs. Collective over the system's communicator.
std::vector<double> stiffness_times(const LinearSystem& system, const std::vector<double>& w);

/// Whether uniform damping of a system acts on the motion about the rest that the run starts from:
/// K u_0 + s G K (u - u_0) in place of K u. False where this rank owns none of its dofs.
bool damped_about_rest(const LinearSystem& system);

/// Whether it does so, the same on all ranks. Collective over the system's communicator.
bool any_damped_about_rest(const LinearSystem& system);

/// K u_0 of the owned dofs where that is so, else nothing [N, N m]. Collective likewise.
std::vector<double> rest_forces(const LinearSystem& system);

/// (K u_0)^T (u_0 / 2 - u_n + dt/2 v-) of these forces on this rank [J]; 0 without.
double rest_work(const std::vector<double>& forces, const LinearSystem& system,
                 const StructureState& state, double time_step);

}  // namespace pounding
