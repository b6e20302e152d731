#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "common/petsc.h"
#include "common/profile.h"
#include "dynamics/batch_step.h"
#include "dynamics/energy_balance.h"
#include "dynamics/state.h"
#include "dynamics/structure_step.h"
#include "dynamics/switched_run.h"
#include "interactions/interaction.h"
#include "motion/ground_motion.h"
#include "motion/load_histories.h"
#include "motion/support_motion.h"
#include "system/linear_system.h"

namespace pounding {

/// Slot of a run among those that are stepped together.
struct BatchSlot {
  /// Null for a structure that is stepped by itself in every run; empty: all are.
  std::span<BatchStep* const> structures;
  std::size_t number = 0;

  BatchStep* of(std::size_t structure) const {
    return structures.empty() ? nullptr : structures[structure];
  }
};

/// CD-Lagrange: central differences with lumped mass and lagged Rayleigh damping, contact as a
/// velocity-impulse complementarity (Ambiel, Brun, Thibon, Gravouil, Eng. Struct. 251 (2022)
/// 113385; Fekak et al., Comput. Mech. 60 (2017)). Displacements are relative to the ground.
///
///     v_free    = v_{n-1/2} + dt ( g - iota a_g(t_n) - alpha v_{n-1/2} )
///                           - dt M^-1 ( K (u_n + beta v_{n-1/2}) + p_n + D v_{n-1/2} )
///     v_{n+1/2} = v_free + sum_k M^-1 b_k^T lambda_k
///     u_{n+1}   = u_n + dt v_{n+1/2}
///
/// with p_n the force of elements that yield, beside K u_n, by their laws (InelasticElements), and
/// loads M^-1 sum_l f_l(t_n) p_l beside the ground's acceleration (LoadShapes).
///
/// With uniform damping in place of Rayleigh's K u_n + p_n goes through damping_filters.h, and
/// D is the extra damping of regions, if any. The impulses lambda_k [N s] are those of interactions
/// (Interaction), one after the other: links, fillers, and unilateral contact (UnilateralContact)
/// last, each by its law and from the velocity that those before it leave.
///
/// The stiffness hands its forces over range by range, and StructureStep updates velocity and
/// displacement there while they are in the nearest cache; interactions then correct the few dofs
/// that they move. The lines of `step` are events of -log_view.
///
/// The first step is half a step of velocity from v_0 at t_0, which makes the scheme second order
/// without damping. Times are n dt, never accumulated. Stable for dt below `stable_time_step`;
/// contact does not lower it. A step allocates nothing, opens nothing, prints nothing.
///
/// Eight runs can share the line `free_velocity`, in a batch: `open` of all, BatchStep::step of
/// every structure in batches, `free_velocity` of all for the others, `close` of all.
class CdLagrange {
 public:
  /// All references must outlive this object. `supports`: null where the ground moves as one;
  /// `loads`: null where no load acts;
  /// `slot`: where the structures of this run are stepped. Collective.
  CdLagrange(MPI_Comm comm, std::span<const LinearSystem> systems, const GroundMotion& motion,
             double time_step, Profile& profile, const SupportMotion* supports = nullptr,
             const LoadHistories* loads = nullptr, BatchSlot slot = {});
  ~CdLagrange();

  /// Takes an interaction in, after those that it has; before the first step. Returns it.
  template <typename Kind>
  Kind& add(std::unique_ptr<Kind> interaction) {
    Kind& added = *interaction;
    interaction->attach(structures_);
    interactions_.push_back(std::move(interaction));
    return added;
  }

  /// The step to t_n, n = state().step; the start at t_0 on the first call. `look_at_gap` makes the
  /// interface gather whatever its distance; `with_energies`: the ledger's line before this step
  /// will be asked for, which takes one more product, K v-; `with_forces`: those at watched dofs
  /// will. Collective; every rank asks alike for energies.
  void step(bool look_at_gap, bool with_energies, bool with_forces = false);
  /// The parts of a step before the structures' own one, elongations and gaps of u_n, and after it,
  /// impulses and ledger; for members of a batch. Returns whether to make it with energies.
  bool open(bool look_at_gap, bool with_energies);
  void close();
  /// v_free, and the u_{n+1} that it leads to, of the structures that no batch steps.
  void free_velocity(bool with_forces);
  /// An interaction asks for the forces of this step, to correct it. After `open`.
  bool corrects() const;

  /// Owned dofs of a structure whose forces a step can be asked for. Before the first step.
  void watch_forces(std::size_t structure, std::span<const LocalIndex> dofs) {
    structures_[structure]->watch(dofs, false);
  }
  /// Force of the last step at a watched dof, if it was asked for: see StructureStep.
  double force(std::size_t structure, LocalIndex dof) const {
    return members_[structure] ? members_[structure]->force(dof)
                               : structure_steps_[structure]->force(0, dof);
  }
  /// Displacement over the owned dofs of a structure, in a batch as well.
  const std::vector<double>& displacement(std::size_t structure) const {
    if (const SwitchedRun* const run = in_modes(structure)) run->bring_all();
    structures_[structure]->bring_state();
    return structures_[structure]->displacement();
  }
  /// Brings displacement and velocity of some owned dofs into the state of a structure in modes.
  void bring(std::size_t structure, std::span<const LocalIndex> dofs) const {
    structures_[structure]->bring(dofs);
  }
  /// Null at full order.
  SwitchedRun* in_modes(std::size_t structure) const;
  /// See BatchMember; in a batch, of a structure that the step brakes.
  double braked(std::size_t structure, std::size_t coordinate) const {
    return members_[structure]->braked(coordinate);
  }

  /// How a run changes between modes and full order, all structures that may be in modes together.
  /// The same on all ranks but for `struck`.
  struct Order {
    bool modes = false;
    std::int64_t next = 2;     ///< step in which to look next whether to change
    std::int64_t struck = -1;  ///< last step in which this rank saw an impulse
    std::int64_t looks = 0;    ///< whether the state fits the modes, so far
    std::int64_t steps = 0;    ///< in modes
    std::int64_t left = 0;     ///< times that modes were left
    std::int64_t least = 0;    ///< steps between looks, and without an impulse before one; 0: none
  };
  const Order& order() const { return order_; }

  /// All that the next step needs, interactions and ledger included, between two steps. Collective.
  void keep(const StateKeeper& state);

  /// State that the next step starts from; in a batch, where a line of the ledger was asked for;
  /// in modes the dofs that were brought.
  const State& state() const { return state_; }
  /// State of a structure as PETSc vectors.
  const StateVectors& vectors(std::size_t structure) const { return vectors_[structure]; }
  double time_step() const { return time_step_; }
  /// Time t_n of the last step.
  double time() const { return static_cast<double>(state_.step - 1) * time_step_; }
  EnergyBalance& energy() { return energy_; }
  const EnergyBalance& energy() const { return energy_; }
  /// Ground acceleration of the current step [m/s2], and how long it acts [s].
  const std::array<double, 3>& ground_acceleration() const { return acceleration_; }
  double force_duration() const { return force_duration_; }
  /// r'' of the supports in the current step, per column of SupportShapes [m/s2, rad/s2].
  const std::vector<double>& support_acceleration() const { return supports_.acceleration; }
  /// f of every load in the current step.
  std::span<const double> load_values() const { return load_values_; }

 private:
  /// Goes to modes if nothing struck for a while and next to nothing lies outside them. Collective.
  void try_modes();
  /// Whether an interaction acts in this step, in modes; else when to look again. Collective.
  bool is_struck();
  void leave_modes();
  bool at_full_order(std::size_t structure) const {
    return !members_[structure] && in_modes(structure) == nullptr;
  }

  /// The step at hand, for interactions.
  interactions::Step at_hand(bool look_at_gap) const;
  /// Motion of ground and supports at t_n.
  void move_ground();
  /// The ledger of the step.
  void close_energy(const interactions::Step& step);

  stiffness::StiffnessArgument argument(std::size_t structure) const;
  /// Forces of the extra damping D; returns v-^T D v- [W].
  double apply_extra_damping(std::size_t structure);

  struct Events {
    LogEvent free_velocity{"free_velocity"};
    LogEvent close_energy{"close_energy"};
  };

  MPI_Comm comm_;
  std::span<const LinearSystem> systems_;
  const GroundMotion& motion_;
  const SupportMotion* support_motion_;
  const LoadHistories* loads_;
  double time_step_;
  Profile& profile_;
  State state_;
  interactions::SupportStep supports_;
  /// Per structure: its own step and run, or its member of a batch.
  std::vector<std::optional<StructureStep<double>>> structure_steps_;
  std::vector<std::optional<SteppedRun<double>>> runs_;
  std::vector<std::optional<BatchMember>> members_;
  std::vector<std::unique_ptr<SwitchedRun>> switched_;  ///< per structure, null: it never is
  Order order_;
  std::vector<std::unique_ptr<interactions::Interaction>> interactions_;
  EnergyBalance energy_;
  std::vector<StepSums> sums_;
  std::vector<double> rest_before_;                          ///< see StepSums
  std::vector<double> load_values_;                          ///< f of every load in the step
  std::vector<interactions::SteppedStructure*> structures_;  ///< runs or members
  std::vector<interactions::LedgerPart*> ledger_;            ///< those of sums_
  std::vector<std::vector<double>> stiffness_velocity_;      ///< K v-, where energies are asked for
  std::vector<StateVectors> vectors_;
  std::vector<std::vector<double>> rest_forces_;  ///< K u_0, see rest_forces
  std::vector<VecHandle> extra_forces_;           ///< as PETSc vectors; null without extra damping
  Events events_;
  std::array<double, 3> acceleration_{};
  std::vector<double> incident_;  ///< velocities of the wave from below [m/s]
  double force_duration_ = 0;
  bool with_energies_ = false;
};

}  // namespace pounding
