#pragma once

#include <vector>

#include "driver/contact_watches.h"
#include "driver/field_plan.h"
#include "ensemble/member_scene.h"

namespace pounding {

/// Numbers of one member of an ensemble, as ensemble.h5 holds them.
struct MemberResult {
  std::vector<double> spectra;      ///< PSA, shape (channels, damping ratios, frequencies) [m/s2]
  std::vector<double> episodes;     ///< per contact, as the next ones
  std::vector<double> first_time;   ///< [s]; not a number without an impact
  std::vector<double> impulse_sum;  ///< [N s]
  std::vector<double> impulse_largest;   ///< of an episode [N s]
  std::vector<double> force_peak;        ///< [N]
  std::vector<double> smallest_gap;      ///< [m]
  std::vector<double> displacement;      ///< largest per channel [m]
  std::vector<double> acceleration;      ///< largest per channel after the low-pass [m/s2]
  std::vector<double> energy_residual;   ///< one number: largest, relative
  std::vector<double> contact_residual;  ///< one number: of complementarity, largest [-]
};

/// One run of a group: the scheme of single runs in a lane, with its interactions, its ledger and
/// those outputs of single runs that an ensemble keeps. Local.
class MemberRun {
 public:
  /// `lane`: where the structures of `model`, which is the member's own, are stepped. The arguments
  /// must outlive this object.
  MemberRun(const MemberScene& member, const EnsembleModel& shared, const Model& model,
            RunLane lane);

  /// Before the structures' step; returns whether that is to be made with energies.
  bool open();
  /// After it. Throws DivergenceError if this member's numbers cannot be trusted.
  void close();
  const CdLagrange& stepper() const { return solver_.stepper(); }

  /// Impacts, gaps and the ledger's residual.
  void fill(MemberResult& result);

 private:
  Profile profile_{Profile::Clock::off};
  Solver solver_;
  ObservedRun run_;
  Observers observers_{profile_};
  ImpactWatch& impacts_;
  std::vector<double> smallest_gaps_;  ///< per contact, of all recorded ones [m]
};

}  // namespace pounding
