#pragma once

#include <optional>
#include <set>
#include <string>

#include "motion/record_text.h"

namespace pounding {

/// What the lines before the values of a record say.
class RecordHeader {
 public:
  explicit RecordHeader(std::string file) : file_(std::move(file)) {}

  /// Takes in a line of text. Throws UserError when it contradicts an earlier one.
  void read(const TextLine& line);

  /// True when a line declares the number of values or the time step.
  static bool declares_sampling(const std::string& line);

  /// Number of values and time step [s] seen at a line; 0: not given there.
  void declare(long long number_of_values, double time_step, int line);

  std::optional<long long> number_of_values() const { return number_of_values_; }
  std::optional<double> time_step() const { return time_step_; }

  /// Throws UserError when the header speaks of velocity or displacement and not of acceleration,
  /// or when the first column is the period or the frequency of a spectrum.
  void require_acceleration() const;

  /// Factor from the file's unit to m/s2: `unit` ("", "g", "m/s2", "cm/s2"), which the header must
  /// not contradict, or else the header's. Throws UserError when neither tells it.
  double unit_factor(const std::string& unit) const;

 private:
  const std::set<std::string>& stated_units() const {
    return units_.empty() ? units_of_peak_ : units_;
  }

  std::string file_;
  std::optional<long long> number_of_values_;
  std::optional<double> time_step_;
  std::set<std::string> units_;          // of the values
  std::set<std::string> units_of_peak_;  // named only where the header quotes a peak
  bool acceleration_ = false;
  bool other_quantity_ = false;
  bool velocity_unit_ = false;
  int other_line_ = 0;
  int spectrum_line_ = 0;
};

}  // namespace pounding
