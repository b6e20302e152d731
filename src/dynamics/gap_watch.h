#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/saved_state.h"
#include "dynamics/energy_balance.h"
#include "system/linear_system.h"

namespace pounding {

/// When the interface has to be looked at again: no message is sent while no gap can close.
///
/// The discrete energy bounds every velocity, |v|_M <= sqrt(2 E / eta), eta the energy margin of
/// the time step, so |L v| <= sqrt(L M^-1 L^T) sqrt(2 E / eta) for each structure's part of a row.
/// Without contact the energy grows by the ground motion only: sqrt(2 E) rises at most by
/// |iota|_M |a_g| / sqrt(eta) per unit of time. A bound, not an estimate: a contact is never
/// missed.
class GapWatch {
 public:
  /// `margins`: energy margin of the time step per structure [-]; `rate_norms` per structure
  /// [kg^-1/2]; `peak_acceleration`: largest norm of the ground acceleration [m/s2].
  GapWatch(std::span<const LinearSystem> systems, std::span<const double> margins,
           std::span<const double> rate_norms, double peak_acceleration, double time_step);

  /// Energies per structure after step `step` [J].
  void energies_known(std::int64_t step, std::span<const StructureEnergy> energies);
  /// The smallest gap above the contact tolerance after a look at step `step` [m]; `touching` if
  /// an impulse acted in that step.
  void looked(std::int64_t step, double clearance, bool touching);

  bool due(std::int64_t step) const { return step >= next_look_; }

  void save(SavedState& saved) const;
  void load(const SavedState& saved);

 private:
  /// Bound of the sum of all gap rates at a step [m/s].
  double rate_bound(std::int64_t step) const;

  double time_step_;
  std::vector<double> rate_per_root_energy_;  ///< per structure: rate norm / sqrt(eta)
  std::vector<double> growth_;                ///< of sqrt(2 E) per step
  std::vector<double> root_energy_;           ///< sqrt(2 E) at energy_step_
  std::int64_t energy_step_ = -1;
  std::int64_t last_touch_ = -1;
  std::int64_t next_look_ = 0;
  bool possible_ = true;
};

}  // namespace pounding
