#pragma once

#include <string>

namespace pounding {

/// How far the time loop is.
struct RunPosition {
  double time = 0;          ///< t_n [s]
  double end_time = 0;      ///< [s]
  double simulated = 0;     ///< since this run began, or went on [s]
  double elapsed = 0;       ///< wall time since then [s]
  double smallest_gap = 0;  ///< [m]; the largest double: no contacts
  long long impacts = 0;
  double energy_residual = 0;  ///< relative
};

/// A duration in words: "45 s", "3 min 20 s", "2 h 05 min".
std::string duration_text(double seconds);

/// One line without its end: percent, simulated time, wall time per simulated second, time left,
/// smallest gap, impacts, energy residual.
std::string progress_line(const RunPosition& position);

/// Shows how far the time loop is: on a terminal a line that overwrites itself, of at most its
/// width; in a file or a pipe a line of its own after one interval, then after twice as much, at
/// most a minute apart, without carriage returns. Of one rank.
class RunProgress {
 public:
  /// `watched`: somebody sees the output as it is written; `interval` [s].
  RunProgress(bool watched, double interval)
      : watched_(watched), interval_(interval), next_(interval) {}

  void show(const RunPosition& position);

 private:
  bool watched_;
  double interval_;
  double next_;  ///< elapsed time of the next line [s]
};

/// Whether somebody sees the standard output as it is written. mpirun gives rank 0 a terminal of
/// its own even where its output goes to a file or a pipe: there the output of mpirun itself
/// counts.
bool is_watched();

/// Columns of the terminal of the standard output, 80 where it does not say.
int terminal_width();

}  // namespace pounding
