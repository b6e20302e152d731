#include "motion/records/record_times.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/error.h"
#include "motion/records/record_text.h"

namespace pounding {

namespace {

constexpr double loose = 0.1;      // part of a step by which a time may be off
constexpr double coarsest = 0.45;  // part of a step to which times may be rounded
constexpr double round_off = 1 + 1e-6;

/// The power of ten to which all times are rounded [s]; 0 when they are not.
double rounding_of(const std::vector<TimeOfLine>& times) {
  double unit = 1;
  for (int decimals = 0; decimals <= 6; ++decimals, unit *= 10) {
    const bool whole = std::all_of(times.begin(), times.end(), [unit](const TimeOfLine& one) {
      const double scaled = one.time * unit;
      return std::abs(scaled - std::round(scaled)) < 1e-6;
    });
    if (whole) return 1 / unit;
  }
  return 0;
}

std::vector<double> steps_between(const std::string& file, const std::vector<TimeOfLine>& times) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) {
    steps.push_back(times[i].time - times[i - 1].time);
    if (!(steps.back() > 0)) {
      throw UserError(at_line(file, times[i].line) + "time " + text_of(times[i].time) +
                      " does not follow " + text_of(times[i - 1].time) + "; times must increase");
    }
  }
  return steps;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The mean step, or a near one that is written shortly or of a whole number of samples a second,
/// where times rounded to `rounding` cannot separate them.
double written_step(double mean, double count, double rounding) {
  const double rounded = std::strtod(text_of(std::round(mean * 1e7) / 1e7).c_str(), nullptr);
  if (std::abs(rounded - mean) * count < 1e-6 * mean) return rounded;
  const double rate = std::round(1 / mean);
  if (rate > 0 && std::abs(1 / rate - mean) * count <= rounding * round_off) return 1 / rate;
  return mean;
}

}  // namespace

double uniform_step(const std::string& file, const std::vector<TimeOfLine>& times) {
  const std::vector<double> steps = steps_between(file, times);
  const double middle = median(steps);
  const double count = static_cast<double>(steps.size());
  const double mean = (times.back().time - times[0].time) / count;
  double rounding = rounding_of(times);
  if (rounding > coarsest * middle) rounding = 0;
  // Two roundings meet in a difference.
  const double allowed = (loose * middle + rounding) * round_off;
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (std::abs(steps[i - 1] - middle) > allowed) {
      throw UserError(at_line(file, times[i].line) + "time " + text_of(times[i].time) + " after " +
                      text_of(times[i - 1].time) + " breaks the uniform step " + text_of(middle) +
                      " s; resample the record or restore the missing lines");
    }
  }
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double place = times[0].time + static_cast<double>(i) * mean;
    if (std::abs(times[i].time - place) > (loose * mean + rounding) * round_off) {
      throw UserError(at_line(file, times[i].line) + "time " + text_of(times[i].time) +
                      " is not where a uniform step " + text_of(mean) +
                      " s puts it; resample the record");
    }
  }
  return written_step(mean, count, rounding);
}

}  // namespace pounding
