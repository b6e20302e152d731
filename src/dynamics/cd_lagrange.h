#pragma once

#include <span>
#include <vector>

#include "common/profile.h"
#include "contact/contact_problem.h"
#include "dynamics/energy_balance.h"
#include "dynamics/gap_watch.h"
#include "dynamics/state.h"
#include "motion/ground_motion.h"
#include "system/linear_system.h"

namespace pounding {

/// CD-Lagrange: central differences with lumped mass and lagged Rayleigh damping, contact as a
/// velocity-impulse complementarity (Ambiel, Brun, Thibon, Gravouil, Eng. Struct. 251 (2022)
/// 113385; Fekak et al., Comput. Mech. 60 (2017)). Displacements are relative to the ground.
///
///     u_{n+1}   = u_n + dt v_{n+1/2}
///     v_free    = v_{n+1/2} + dt ( g - iota a_g(t_{n+1}) - alpha v_{n+1/2} )
///                           - dt M^-1 ( K (u_{n+1} + beta v_{n+1/2}) + x )
///     A         = { i : g_i(u_{n+1}) <= g_tol }
///     0 <= lambda _|_ H lambda + L v_free >= 0   on A
///     v_{n+3/2} = v_free + M^-1 L^T lambda
///
/// with x the force of dashpots and tension-only bars, if there are any.
///
/// The first step is half a step of velocity from v_0 at t_0, which makes the scheme second order
/// without damping. Times are n dt, never accumulated. Stable for dt below `stable_time_step`;
/// contact does not lower it. A step allocates nothing, opens nothing, prints nothing.
class CdLagrange {
 public:
  /// All references must outlive this object. `contact` may be null. Collective.
  CdLagrange(MPI_Comm comm, std::span<const LinearSystem> systems, const GroundMotion& motion,
             ContactProblem* contact, GapWatch watch, double time_step, Profile& profile);

  /// The start at t_0 on the first call, then one step per call. `look_at_gap` makes the interface
  /// gather whatever its distance; `with_energies`: a line of the ledger will be asked for.
  /// Collective.
  void step(bool look_at_gap, bool with_energies);

  const State& state() const { return state_; }
  double time_step() const { return time_step_; }
  double time() const { return static_cast<double>(state_.step) * time_step_; }
  EnergyBalance& energy() { return energy_; }
  GapWatch& gap_watch() { return watch_; }
  /// This rank holds the gaps and impulses of the current step.
  bool interface_known() const { return interface_known_; }
  bool touching() const { return touching_; }
  const ContactProblem* contact() const { return contact_; }
  /// Ground acceleration of the current step [m/s2], and how long it acts [s].
  const std::array<double, 3>& ground_acceleration() const { return acceleration_; }
  double force_duration() const { return force_duration_; }

 private:
  void advance_displacement();
  void apply_stiffness();
  void apply_devices();
  void compute_free_velocity(double duration);
  bool solve_contact(bool look_at_gap);

  std::span<const LinearSystem> systems_;
  const GroundMotion& motion_;
  ContactProblem* contact_;
  GapWatch watch_;
  double time_step_;
  Profile& profile_;
  State state_;
  EnergyBalance energy_;
  bool counts_work_;                           ///< this rank adds the contact work to the ledger
  std::vector<VecHandle> arguments_;           ///< w of each structure as a PETSc vector
  std::vector<VecHandle> forces_;              ///< q
  std::vector<VecHandle> dashpot_velocities_;  ///< v, for the dashpots
  std::vector<VecHandle> device_forces_;
  std::vector<const double*> displacements_;
  std::vector<double*> velocities_;
  std::vector<const double*> const_velocities_;
  std::array<double, 3> acceleration_{};
  double force_duration_ = 0;
  bool started_ = false;
  bool interface_known_ = false;
  bool touching_ = false;
};

}  // namespace pounding
