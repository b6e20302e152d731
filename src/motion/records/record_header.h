#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "motion/records/record_text.h"
#include "motion/records/record_unit.h"

namespace pounding {

/// Units of acceleration that a line names: g, m/s2, cm/s2 (also gal), mm/s2, g/10.
std::set<std::string> units_in(const std::string& text);

/// The component that a line of a header names ("N10E", "90 Deg", "UP", "Longitudinal"), or "".
std::string component_in(const std::string& text);

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
  /// Time step [s], or the step of the only sampling rate where no step is stated.
  std::optional<double> time_step() const;
  /// The component that a line names, "" where none does.
  const std::string& component() const { return component_; }

  /// Throws UserError when the header speaks of velocity or displacement and not of acceleration,
  /// when the values are counts of a recorder, and when the first column is the period or the
  /// frequency of a spectrum.
  /// `displacement` is asked in place of acceleration.
  void require_acceleration(bool displacement) const;

  /// `asked` ("", "g", "m/s2", "cm/s2", "mm/s2"), which the header must not contradict, or else the
  /// header's unit. Throws UserError when neither states it.
  RecordUnit unit(const std::string& asked) const;

  /// Units of the values, or those of a peak that is quoted where there are none.
  const std::set<std::string>& stated_units() const {
    return units_.empty() ? units_of_peak_ : units_;
  }

 private:
  [[noreturn]] void contradiction(int line, const char* what, const std::string& here,
                                  const std::string& before) const;
  void take_sampling(const std::string& text, int line);

  std::string file_;
  std::optional<long long> number_of_values_;
  std::optional<double> time_step_;
  std::optional<double> step_of_rate_;  // [s]
  bool rates_differ_ = false;
  std::string component_;
  std::set<std::string> units_;          // of the values
  std::set<std::string> units_of_peak_;  // named only where the header quotes a peak
  bool acceleration_ = false;
  bool other_quantity_ = false;
  bool velocity_unit_ = false;
  int other_line_ = 0;
  int spectrum_line_ = 0;
  int counts_line_ = 0;
};

/// A record of text, header and numbers apart, before their layout is decided.
struct RecordContent {
  RecordHeader header;
  std::vector<NumberRow> rows;     ///< the values, line by line
  std::vector<std::string> names;  ///< of the columns, when the header gives as many as there are
};

/// Splits the lines of `file`; a first row of its own kind (`npts dt`, `npts`, or `dt scale` with
/// the time step known from the header or the option) goes to the header. Throws UserError when
/// there are no numbers, or anything else among them, and when the header is not an accelerogram's,
/// or not that of the displacement asked for.
RecordContent read_record_content(const std::string& file, const std::vector<TextLine>& lines,
                                  double time_step_option, bool of_displacement);

}  // namespace pounding
