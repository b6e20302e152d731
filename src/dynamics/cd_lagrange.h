#pragma once

#include <memory>
#include <span>
#include <vector>

#include "common/log_event.h"
#include "common/profile.h"
#include "dynamics/energy_balance.h"
#include "dynamics/filler_step.h"
#include "dynamics/gap_watch.h"
#include "dynamics/link_step.h"
#include "dynamics/state.h"
#include "dynamics/structure_step.h"
#include "dynamics/support_step.h"
#include "interactions/contact_problem.h"
#include "motion/ground_motion.h"
#include "motion/support_motion.h"
#include "system/linear_system.h"

namespace pounding {

/// CD-Lagrange: central differences with lumped mass and lagged Rayleigh damping, contact as a
/// velocity-impulse complementarity (Ambiel, Brun, Thibon, Gravouil, Eng. Struct. 251 (2022)
/// 113385; Fekak et al., Comput. Mech. 60 (2017)). Displacements are relative to the ground.
///
///     A         = { i : g_i(u_n) <= g_tol }
///     v_free    = v_{n-1/2} + dt ( g - iota a_g(t_n) - alpha v_{n-1/2} )
///                           - dt M^-1 ( K (u_n + beta v_{n-1/2}) + D v_{n-1/2} )
///     v_free   <- v_free - dt M^-1 sum_k b_k N_k      links (LinkStep), then fillers (FillerStep)
///     0 <= lambda _|_ H lambda + L v_free >= 0   on A
///     v_{n+1/2} = v_free + M^-1 L^T lambda
///     u_{n+1}   = u_n + dt v_{n+1/2}
///
/// with uniform damping in place of Rayleigh's the force K u_n goes through filters (update.h), and
/// D is the extra damping of regions, if any. The force N_k of a link depends on the velocity that
/// it leaves, and is solved for with those of the links that it moves.
/// `step` has a line for each of these; they are events of -log_view under the same names. The
/// stiffness hands its forces over range by range, and StructureStep updates velocity and
/// displacement there while they are in the nearest cache; contact then corrects the few dofs of
/// the interface.
///
/// The first step is half a step of velocity from v_0 at t_0, which makes the scheme second order
/// without damping. Times are n dt, never accumulated. Stable for dt below `stable_time_step`;
/// contact does not lower it. A step allocates nothing, opens nothing, prints nothing.
class CdLagrange {
 public:
  /// All references must outlive this object. `contact` and `fillers` may be null, and `supports`
  /// where the ground moves as one. Collective.
  CdLagrange(MPI_Comm comm, std::span<const LinearSystem> systems, const GroundMotion& motion,
             interactions::ContactProblem* contact, FillerStep* fillers, GapWatch watch,
             double time_step, Profile& profile, const SupportMotion* supports = nullptr);

  /// The step to t_n, n = state().step; the start at t_0 on the first call. `look_at_gap` makes the
  /// interface gather whatever its distance; `with_energies`: the ledger's line before this step
  /// will be asked for, which takes one more product, K v-; `with_forces`: those at watched dofs
  /// will. Collective; every rank asks alike for energies.
  void step(bool look_at_gap, bool with_energies, bool with_forces = false);

  /// Owned dofs of a structure whose forces a step can be asked for. Before the first step.
  void watch_forces(std::size_t structure, std::span<const LocalIndex> dofs) {
    structure_steps_[structure].watch(dofs, false);
  }
  /// Forces of the last step at watched dofs, if they were asked for.
  const KeptForces& forces(std::size_t structure) const {
    return structure_steps_[structure].forces();
  }

  /// Everything that the next step needs, contact and ledger included, between two steps.
  void save(SavedState& saved) const;
  void load(const SavedState& saved);

  /// State that the next step starts from.
  const State& state() const { return state_; }
  /// State of a structure as PETSc vectors.
  const StateVectors& vectors(std::size_t structure) const { return vectors_[structure]; }
  double time_step() const { return time_step_; }
  /// Time t_n of the last step.
  double time() const { return static_cast<double>(state_.step - 1) * time_step_; }
  EnergyBalance& energy() { return energy_; }
  const EnergyBalance& energy() const { return energy_; }
  GapWatch& gap_watch() { return watch_; }
  /// This rank holds the gaps and impulses of the current step.
  bool interface_known() const { return interface_known_; }
  bool touching() const { return touching_; }
  /// Steps so far in which the interface was looked at; members of the interface only.
  std::int64_t looks() const { return looks_; }
  const interactions::ContactProblem* contact() const { return contact_; }
  /// Compression-only springs of a structure after the last step, those of this rank.
  LinkStep::Bedding bedding(std::size_t structure) const {
    return link_steps_[structure] ? link_steps_[structure]->bedding() : LinkStep::Bedding{};
  }
  /// The links of a structure on this rank; null if it has none.
  LinkStep* link_step(std::size_t structure) { return link_steps_[structure].get(); }
  const LinkStep* link_step(std::size_t structure) const { return link_steps_[structure].get(); }
  /// Ground acceleration of the current step [m/s2], and how long it acts [s].
  const std::array<double, 3>& ground_acceleration() const { return acceleration_; }
  double force_duration() const { return force_duration_; }

 private:
  /// A of u_n, where the interface is looked at; keeps what contact will change.
  void detect_contact(bool look_at_gap);
  /// d_n of fillers, and what contact and they will change.
  void measure_fillers();
  /// Adds what fillers press to v_free.
  void press_fillers();
  /// v_free and the u_{n+1} that it leads to; sums for the ledger.
  void free_velocity(bool with_energies, bool with_forces);
  /// (K u_0)^T (u_0 / 2 - u_n + dt/2 v-) of this rank [J], 0 but where uniform damping acts about a
  /// rest.
  double about_rest(std::size_t structure) const;
  /// lambda on A.
  void solve_impulse();
  /// v_{n+1/2}, u_{n+1} at the dofs that contact moves.
  void correct_velocity();
  /// The ledger of the step.
  void close_energy();

  stiffness::StiffnessArgument argument(std::size_t structure) const;
  /// Forces of the extra damping D; returns v-^T D v- [W].
  double apply_extra_damping(std::size_t structure);

  struct Events {
    LogEvent detect_contact{"detect_contact"};
    LogEvent free_velocity{"free_velocity"};
    LogEvent solve_impulse{"solve_impulse"};
    LogEvent correct_velocity{"correct_velocity"};
    LogEvent close_energy{"close_energy"};
  };

  std::span<const LinearSystem> systems_;
  const GroundMotion& motion_;
  const SupportMotion* support_motion_;
  interactions::ContactProblem* contact_;
  FillerStep* fillers_;
  GapWatch watch_;
  double time_step_;
  Profile& profile_;
  State state_;
  SupportStep supports_;
  std::vector<StructureStep> structure_steps_;
  std::vector<std::unique_ptr<LinkStep>> link_steps_;  ///< null where there are no such bars
  EnergyBalance energy_;
  bool counts_work_;  ///< this rank adds the contact work to the ledger
  std::vector<StepSums> sums_;
  std::vector<std::vector<double>> stiffness_velocity_;  ///< K v-, where energies are asked for
  /// Per structure, the dofs that move its interface: what they held before the step, and their
  /// velocity in it.
  std::vector<StructureStep::Before> before_;
  std::vector<std::vector<double>> interface_velocity_;
  std::vector<StateVectors> vectors_;
  std::vector<std::vector<double>> rest_forces_;  ///< K u_0, see rest_forces
  std::vector<VecHandle> extra_forces_;           ///< as PETSc vectors; null without extra damping
  Events events_;
  std::array<double, 3> acceleration_{};
  Vector3 incident_{};  ///< velocity of the wave from below [m/s]
  double force_duration_ = 0;
  bool interface_known_ = false;
  bool touching_ = false;
  std::int64_t looks_ = 0;
};

}  // namespace pounding
