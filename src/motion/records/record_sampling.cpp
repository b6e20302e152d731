#include "motion/records/record_sampling.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <regex>

#include "common/error.h"
#include "common/series.h"
#include "motion/records/record_text.h"

namespace pounding {
namespace {

constexpr auto pattern_flags = std::regex::ECMAScript | std::regex::icase;

const std::string number = R"(([-+]?(?:\d+\.?\d*|\.\d+)(?:[ED][-+]?\d+)?))";
const std::string gap = R"([\s"',:=]*)";
const std::string in_brackets = R"((?:\s*[(\[]\s*(HZ|SPS|MS(?:EC)?|S(?:EC(?:ONDS?)?)?)\s*[)\]])?)";
const std::string behind = R"(\s*(HZ\b|SPS\b|MS(?:EC)?\b|S(?:EC(?:ONDS?)?)?\b)?)";
const std::string spanish = R"([^:=]*[:=]\s*/?\s*)";

// NPTS= 4000 | "Total No. of Points :",2000 | NDATA: 64 | NUM. TOTAL DE MUESTRAS, C1 : /1234
// and 3000 points of accel data
const std::array count_patterns{
    std::regex("\\bNPTS" + gap + number, pattern_flags),
    std::regex("\\bN(?:O|UM|UMBER)?\\.?\\s*OF\\s*(?:DATA\\s*)?POINTS" + gap + number,
               pattern_flags),
    std::regex("\\b(?:NDATA|NUMBER[ _]+OF[ _]+(?:DATA|SAMPLES))" + gap + number, pattern_flags),
    std::regex("\\bNUM(?:ERO)?\\.?\\s+TOTAL\\s+DE\\s+MUESTRAS" + spanish + number, pattern_flags),
    std::regex(R"((\d+)\s+POINTS\s+(?:OF|AT)\b)", pattern_flags)};

// DT= .01 SEC | equally spaced at .02 sec | equally spaced intervals of: 0.005 SEC | DT: 20 msec
const std::array step_patterns{
    std::regex(
        R"((?:\bDT|\bSPACED\s+AT|\bSPACING\s+OF|\bSPACED\s+INTERVALS\s+OF|\bTIME[ _]STEP|\bDELTA[ _-]?T\b)"
        R"(|\bSAMPL(?:E|ING)[ _](?:INTERVAL|PERIOD|STEP)(?:_S)?))" +
            in_brackets + gap + number + behind,
        pattern_flags),
    std::regex("\\bINTERVALO\\s+DE\\s+MUESTREO()" + spanish + number + behind, pattern_flags),
    std::regex("\\bAT()\\s+" + number + R"(\s*(S(?:EC)?)\s+INTERVALS)", pattern_flags)};

// Sampling Freq(Hz) 100Hz | VEL. DE MUESTREO, C1 (muestras/s) : /50 | 50 sps, 200 samples/sec
const std::array rate_patterns{
    std::regex("\\bSAMPL(?:E|ES|ING)[ _]*(?:FREQ(?:UENCY)?|RATE)\\.?" + in_brackets + gap + number +
                   behind,
               pattern_flags),
    std::regex("\\b(?:VEL(?:OCIDAD)?\\.?|FREC(?:UENCIA)?\\.?|TASA)\\s+DE\\s+MUESTREO()" + spanish +
                   number + "()",
               pattern_flags),
    std::regex(
        "()" + number + R"(\s*()(?:SPS\b|SAMPLES?\s*/\s*S(?:EC(?:OND)?)?\b|SAMPLES\s+PER\s+SEC))",
        pattern_flags)};

// 4096    0.0100    NPTS, DT
const std::regex trailing_names(R"(^\s*(\d+)\s+)" + number + R"(\s+NPTS\s*,?\s*DT)", pattern_flags);
// %   2990    5.00000E-03  0  0  0.
const std::regex numbers_in_comment(R"(^\s*[%#;!]\s*(\d+)\s+)" + number + R"(\s+[-+0-9.ED\s]*$)",
                                    pattern_flags);
// NPTS= ****
const std::regex no_number(R"(\b(NPTS|DT)\s*[=:]\s*(?![-+.\d\s"',]))", pattern_flags);

double value(const std::string& text) {
  return parse_number(text).value_or(0);
}

/// The value of a match of three groups (unit before it, number, unit behind it), and its unit as a
/// small letter: h for hertz, s for seconds, m for milliseconds, a blank for none.
struct Quantity {
  double number = 0;
  char unit = ' ';
};

Quantity quantity(const std::smatch& match) {
  const std::string unit = match[3].length() > 0 ? match[3].str() : match[1].str();
  Quantity result{value(match[2].str())};
  if (unit.empty()) return result;
  const auto small = [&](std::size_t i) {
    return i < unit.size() ? std::tolower(static_cast<unsigned char>(unit[i])) : 0;
  };
  const bool per_second = small(0) == 'h' || (small(0) == 's' && small(1) == 'p');
  result.unit = per_second ? 'h' : static_cast<char>(small(0));
  return result;
}

/// Looks for the first of the patterns that a text has.
bool find_first(const std::string& text, std::smatch& match, std::span<const std::regex> patterns) {
  return std::ranges::any_of(
      patterns, [&](const std::regex& one) { return std::regex_search(text, match, one); });
}

void read_step(const std::string& text, StatedSampling& stated) {
  std::smatch match;
  if (find_first(text, match, step_patterns)) {
    const Quantity step = quantity(match);
    stated.time_step = step.number * (step.unit == 'm' ? 1e-3 : 1);
  } else if (find_first(text, match, rate_patterns)) {
    const Quantity rate = quantity(match);
    if (rate.unit == 's' || rate.unit == 'm') {
      stated.time_step = rate.number * (rate.unit == 'm' ? 1e-3 : 1);
    } else {
      stated.rate = rate.number;
    }
  }
}

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

StatedSampling read_sampling(const std::string& text) {
  StatedSampling stated;
  std::smatch match;
  if (std::regex_search(text, match, trailing_names)) {
    return {value(match[1].str()), value(match[2].str()), {}};
  }
  if (find_first(text, match, count_patterns)) stated.count = value(match[1].str());
  read_step(text, stated);
  if (std::regex_search(text, match, numbers_in_comment) && value(match[2].str()) > 0 &&
      value(match[2].str()) < 1) {
    stated.count = value(match[1].str());
    stated.time_step = value(match[2].str());
  }
  return stated;
}

std::string without_rate(const std::string& text) {
  std::string rest = text;
  for (const std::regex& pattern : rate_patterns) rest = std::regex_replace(rest, pattern, " ");
  return rest;
}

std::string name_without_number(const std::string& text) {
  std::smatch match;
  return std::regex_search(text, match, no_number) ? match[1].str() : "";
}

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
