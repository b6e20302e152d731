#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/saved_state.h"
#include "dynamics/coordinate_rates.h"
#include "dynamics/energy_balance.h"
#include "system/linear_system.h"

namespace pounding {

/// When the interface has to be looked at again: no message is sent while no gap can close.
///
/// The discrete energy bounds every velocity, v^T A v <= 2 E with A = M - dt/2 C - dt^2/4 K, so
/// |L v| <= sqrt(L A^-1 L^T) sqrt(2 E) for each structure's part of a row. Without contact the
/// energy grows by the ground motion and gravity only: sqrt(2 E) rises at most by |M iota a| in the
/// norm of A^-1 per unit of time. Structures in generalised coordinates are bounded coordinate by
/// coordinate, far more closely. Bounds, not estimates: a contact is never missed.
class GapWatch {
 public:
  /// Bound of the velocities of one structure.
  struct Bound {
    /// Upper bound of the largest sqrt(L A^-1 L^T) [kg^-1/2]; infinite where nothing bounds it.
    double rate_norm = 0;
    /// Upper bound of |M iota| of each direction in the norm of A^-1 [kg^1/2].
    std::array<double, 3> force_norm{};
    /// L T in place of these two where the structure goes by coordinates, see CoordinateRates.
    std::vector<double> coordinate_rows;
    /// Norm of the weight less K u_0, where uniform damping acts about a rest: it takes the place
    /// of the weight [kg^1/2 m/s2].
    std::optional<double> rest_norm{};
  };

  /// Whether a structure is bounded coordinate by coordinate.
  static bool goes_by_coordinates(const LinearSystem& system) {
    return system.generalised && !system.has_extra_damping() && !system.links;
  }

  /// `peaks`: largest ground acceleration in each direction [m/s2]. Collective.
  GapWatch(std::span<const LinearSystem> systems, std::vector<Bound> bounds, const Vector3& peaks,
           double time_step);

  /// Energies per structure after step `step` [J], and by how much round-off may have made each
  /// one smaller than it is [J].
  void energies_known(std::int64_t step, std::span<const StructureEnergy> energies,
                      std::span<const double> round_off);

  /// Some structure is bounded by the sums that `measure` reads; the same on all ranks.
  bool measures() const { return measures_; }
  /// This rank's part of the bounds: add up over ranks before they go into `looked`.
  std::span<double> measure(std::span<const StructureState> structures);
  /// The smallest gap above the contact tolerance after a look at step `step` [m]; `touching` if
  /// an impulse acts in that step.
  void looked(std::int64_t step, double clearance, bool touching);

  bool due(std::int64_t step) const { return step >= next_look_; }
  /// Whether a look that finds nothing closed is worth `measure` and `looked`: one that was made
  /// for another reason, before it was due, leaves the last bound in force where to measure costs
  /// as much as to look.
  bool needs_look(std::int64_t step) const { return !measures_ || due(step); }

  void save(SavedState& saved) const;
  void load(const SavedState& saved);

 private:
  /// Bound of the sum of all gap rates at a step after a look at step `look` [m/s].
  double rate_bound(std::int64_t look, std::int64_t step) const;

  double time_step_;
  std::vector<std::unique_ptr<CoordinateRates>> coordinates_;  ///< per structure; null: by energy
  std::vector<double> measured_;     ///< per structure, rate [m/s] and growth per step
  std::vector<double> rate_norm_;    ///< per structure
  std::vector<double> growth_;       ///< of sqrt(2 E) per step
  std::vector<double> root_energy_;  ///< sqrt(2 E) at energy_step_, round-off included
  std::int64_t energy_step_ = -1;
  std::int64_t last_touch_ = -1;
  std::int64_t next_look_ = 0;
  bool possible_ = true;
  bool measures_ = false;
  bool needs_energy_ = false;
};

}  // namespace pounding
