#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/saved_state.h"
#include "dynamics/energy_balance.h"

namespace pounding {

/// The lines of the energy balance that are kept: all of a short run, every n-th of a long one.
class EnergyLedger {
 public:
  /// `expected_lines`: of the whole run.
  explicit EnergyLedger(std::int64_t expected_lines);

  void add(const EnergyLine& line);
  const std::vector<EnergyLine>& lines() const { return lines_; }
  /// The last one added, kept or not.
  const EnergyLine& last() const { return last_; }

  void keep(const StateKeeper& state);

 private:
  std::int64_t stride_;  ///< lines added per line kept
  std::int64_t added_ = 0;
  std::vector<EnergyLine> lines_;
  EnergyLine last_;
};

/// Columns of `energy.csv`.
std::string energy_columns();

/// `energy.csv`: one row per line, of `digits` significant digits. Throws UserError if the file
/// cannot be written.
void write_energy(const std::string& path, const std::vector<EnergyLine>& lines, int digits);

}  // namespace pounding
