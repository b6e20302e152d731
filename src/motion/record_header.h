#pragma once

#include <optional>
#include <set>
#include <string>

#include "motion/record_text.h"

namespace pounding {

/// Unit of a record and the factor from it to m/s2.
struct RecordUnit {
  std::string name;
  double factor = 1;
};

/// Content of the lines before the values of a record.
class RecordHeader {
 public:
  explicit RecordHeader(std::string file) : file_(std::move(file)) {}

  /// Takes in a line of text. Throws UserError when it contradicts an earlier one.
  void read(const TextLine& line);

  /// True when a line declares the number of values or the time step.
  static bool declares_sampling(const std::string& line);

  /// Number of values seen at a line. Throws UserError when it cannot be one.
  void declare_count(double number_of_values, int line);
  /// Time step [s] seen at a line. Throws UserError when it is not positive.
  void declare_time_step(double time_step, int line);

  std::optional<long long> number_of_values() const { return number_of_values_; }
  std::optional<double> time_step() const { return time_step_; }

  /// Throws UserError when the header speaks of velocity or displacement and not of acceleration,
  /// or when the first column is the period or the frequency of a spectrum.
  void require_acceleration() const;

  /// `asked` ("", "g", "m/s2", "cm/s2"), which the header must not contradict, or else the header's
  /// unit. Throws UserError when neither tells it.
  RecordUnit unit(const std::string& asked) const;

 private:
  [[noreturn]] void contradiction(int line, const char* what, const std::string& here,
                                  const std::string& before) const;
  void read_sampling(const std::string& text, int line);

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
