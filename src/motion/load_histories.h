#pragma once

#include <span>
#include <string>
#include <vector>

#include "scene/load.h"

namespace pounding {

/// Histories of the loads of a scene, f_l(t) with their factors: numbers without unit that multiply
/// the forces of each load.
class LoadHistories {
 public:
  /// Reads the tables; every rank may do so. Throws UserError naming load, file and line.
  explicit LoadHistories(std::span<const Load> loads);

  std::size_t size() const { return histories_.size(); }
  /// f of all loads at time t [s].
  void evaluate(double t, std::span<double> values) const noexcept;
  /// f of a load before the run: constant loads and tables act at rest with their value at t = 0;
  /// steps, ramps and harmonic loads set in with the run at the earliest.
  double before_start(std::size_t load) const noexcept;
  /// Largest |f| of a load from the start of a run to its `end` [s].
  double peak(std::size_t load, double end) const;
  /// Frequency of the fastest part of a load until `end` [s]: that of a harmonic one, of a table
  /// one over twice the width of its narrowest peak at half of the height [Hz]; 0: none. `sudden`:
  /// a first value that is not 0 comes at once.
  double fastest(std::size_t load, double end, bool sudden) const;
  /// Loads that are 0 throughout a run until `end` [s], and those whose times may be meant in the
  /// times of records that begin at `origin` [s].
  std::vector<std::string> doubts(std::span<const Load> loads, double origin, double end) const;
  /// "ramp from 0.1 s on, over 0.05 s", for the report.
  std::string describe(std::size_t load) const;
  /// The history of a load, its table read.
  const LoadFunction& function(std::size_t load) const { return histories_[load].function; }

 private:
  struct History {
    LoadFunction function;
    double factor = 1;
  };
  std::vector<History> histories_;
};

}  // namespace pounding
