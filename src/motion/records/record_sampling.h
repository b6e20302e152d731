#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pounding {

/// The sampling that a line of a header states, in whatever words and languages headers use.
struct StatedSampling {
  std::optional<double> count;      ///< number of values
  std::optional<double> time_step;  ///< [s]
  std::optional<double> rate;       ///< [Hz]

  bool any() const { return count || time_step || rate; }
};

/// Reads a line: NPTS= 4000, DT= .01 SEC; 3000 points of accel data equally spaced at .02 sec;
/// Sampling Freq(Hz) 100Hz; 50 sps; VEL. DE MUESTREO : /100; ... A rate given in seconds is a step.
StatedSampling read_sampling(const std::string& text);

/// The line without words that state a sampling rate, which may speak of a "velocity" (Spanish) or
/// a "frequency" that is not that of the values.
std::string without_rate(const std::string& text);

/// The name behind which a number is missing ("NPTS= ****"), or "".
std::string name_without_number(const std::string& text);

/// A time of a record [s] and its line.
struct TimeOfLine {
  double time = 0;
  int line = 0;
};

/// Time step of uniform times. Each may be off its place by a tenth of a step, and where times are
/// written with few decimals by their rounding as well; a whole number of samples a second that
/// explains the rounded times is the rate then. Throws UserError when times do not increase or a
/// step is broken.
double uniform_step(const std::string& file, const std::vector<TimeOfLine>& times);

}  // namespace pounding
