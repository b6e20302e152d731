#pragma once

#include <cstdio>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>

#include "io/new_file.h"

namespace pounding {

/// A CSV file: one header line, then rows of numbers. Comment lines ("# ") precede the header in
/// files that the program itself reads back, in no others: a spreadsheet takes the first line for
/// the names of the columns. A file that is not closed goes again, so that a file that is there is
/// complete. Throws UserError if it cannot be opened or written.
class CsvFile {
 public:
  /// `path` empty or "/dev/stdout": the standard output of the program, wherever its end is; opened
  /// by name it would begin again at the start of its file. Other names in /dev are written as they
  /// are, every other one is taken anew (NewFile). `digits`: significant ones of each number; 17
  /// give it back to the bit.
  explicit CsvFile(const std::string& path, int digits = 17);
  CsvFile(const CsvFile&) = delete;
  CsvFile& operator=(const CsvFile&) = delete;
  ~CsvFile();

  void comment(const std::string& text) { std::fprintf(file_, "# %s\n", text.c_str()); }
  void header(const std::string& names) { std::fprintf(file_, "%s\n", names.c_str()); }
  /// A row; `label` is its first field unless it is empty.
  void row(const std::string& label, std::span<const double> values);
  void row(const std::string& label, std::initializer_list<double> values) {
    row(label, std::span(values.begin(), values.size()));
  }
  /// Throws if anything was not written and somebody reads it. Standard output stays open.
  void close();

 private:
  enum class Target { standard_output, device, file };

  Target target_;
  std::string path_;
  int digits_;
  std::optional<NewFile> new_file_;
  std::FILE* file_ = nullptr;
};

/// A text as the cell of a table that people open: a spreadsheet runs one that begins as a formula
/// does, so an apostrophe precedes it unless it is numbers.
std::string plain_cell(const std::string& text);

/// Columns of a table of response spectra, those of a run and those of pounding-spectra alike:
/// source, direction and treatment of the signal; damping ratio [-], frequency [Hz], period [s],
/// largest displacement [m], pseudo-velocity [m/s] and pseudo-acceleration [m/s2]; then the origin
/// of the row: interval between the samples [s], frequency up to which they hold it [Hz], start of
/// the part that counts [s], part by which peaks were widened to both sides [-].
inline constexpr const char* spectrum_columns =
    "probe,direction,treatment,damping,frequency,period,displacement,pseudo_velocity,"
    "pseudo_acceleration,interval,valid_up_to,start,broadening";

/// Frequency [Hz] up to which samples that are means over their `interval` [s] hold a response
/// spectrum within 1 %: they lower it by about (pi f interval)^2 / 2, which is 1 % at 0.045.
inline double faithful_up_to(double interval) {
  return 0.045 / interval;
}

}  // namespace pounding
