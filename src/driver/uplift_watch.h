#pragma once

#include <vector>

#include <mpi.h>

#include "common/saved_state.h"
#include "driver/solver.h"

namespace pounding {

/// Contact ratio of a mat on compression-only springs: the stiffness of those that are pressed over
/// that of all, 1 as long as nothing lifts off.
struct ContactRatio {
  double now = 1;           ///< at the last look
  double smallest = 1;      ///< of all looks
  double time = 0;          ///< of the smallest [s]
  double low_duration = 0;  ///< time below 80 % [s]

  /// Ratio below which the time counts.
  static constexpr double low = 0.8;
};

/// Watches the contact ratio of every structure that has compression-only springs, at the lines of
/// the energy ledger.
class UpliftWatch {
 public:
  UpliftWatch(MPI_Comm comm, std::size_t structures) : comm_(comm), ratios_(structures) {}

  /// `interval` since the look before [s]. Collective.
  void look(const Solver& solver, double interval);
  const std::vector<ContactRatio>& ratios() const { return ratios_; }  ///< per structure

  /// Ratios are alike on all ranks; one saves.
  void save(SavedState& saved) const;
  void load(const SavedState& saved);

 private:
  MPI_Comm comm_;
  std::vector<ContactRatio> ratios_;
};

}  // namespace pounding
