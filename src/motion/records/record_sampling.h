#pragma once

#include <optional>
#include <string>

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

}  // namespace pounding
