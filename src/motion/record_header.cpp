#include "motion/record_header.h"

#include <cmath>
#include <regex>

#include "common/error.h"
#include "motion/accelerogram.h"

namespace pounding {

namespace {

constexpr std::size_t longest_header_line = 400;
constexpr auto flags = std::regex::ECMAScript | std::regex::icase;

const std::string number = R"(([-+]?(?:\d+\.?\d*|\.\d+)(?:[ED][-+]?\d+)?))";
const std::string gap = R"([\s"',:=]*)";
const std::string squared = R"(\s*/\s*S(?:EC)?\s*(?:/\s*S(?:EC)?|\^?\s*2|\*\*\s*2))";

// NPTS= 4000 | Total No. of Points :",2000 | 3000 points of accel data
const std::regex count_pattern("\\bNPTS" + gap + "(\\d+)|\\bNO\\.? OF POINTS" + gap +
                                   R"((\d+)|(\d+)\s+POINTS\s+(?:OF|AT)\b)",
                               flags);
// DT= .01 SEC | equally spaced at .02 sec | equal spacing of 0.02 sec
const std::regex step_pattern(R"((?:\bDT|\bSPACED\s+AT|\bSPACING\s+OF|\bTIME[ _]STEP))" + gap +
                                  number + R"(\s*(ms(?:ec)?\b)?)",
                              flags);
// 4096    0.0100    NPTS, DT
const std::regex trailing_names(R"(^\s*(\d+)\s+)" + number + R"(\s+NPTS\s*,?\s*DT)", flags);
// %   2990    5.00000E-03  0  0  0.
const std::regex numbers_in_comment(R"(^\s*[%#;!]\s*(\d+)\s+)" + number + R"(\s+[-+0-9.ED\s]*$)",
                                    flags);

const std::regex cm_pattern("\\bCM" + squared + R"(|\bGALS?\b)", flags);
const std::regex m_pattern("(?:^|[^A-Z])M" + squared, flags);
const std::regex g_pattern(R"([(\[]\s*G\s*[)\]]|\bUNITS?\s*(?:OF|ARE|IS|IN)?[\s:="]*G\b(?!\s*/))"
                           R"(|\bIN\s+G\b(?!\s*/))",
                           flags);
const std::regex velocity_unit_pattern(R"(\bC?M\s*/\s*S(?:EC)?\b(?!\s*(?:/|\^|\*|2)))", flags);
const std::regex peak_pattern(R"(\b(?:PEAK|MAX(?:IMUM)?)\b)", flags);
const std::regex acceleration_pattern(R"((?:^|[^A-Z])ACC)", flags);
const std::regex other_pattern(R"((?:^|[^A-Z])(?:VEL|DISPL?)(?:[^A-Z]|OCITY|ACEMENT|$))", flags);
const std::regex spectrum_pattern(R"(^\W*(?:PERIODS?\b|FREQ(?:UENCY)?\s*[\[(,;]))", flags);

}  // namespace

bool RecordHeader::declares_sampling(const std::string& line) {
  const std::string text = line.substr(0, longest_header_line);
  return std::regex_search(text, count_pattern) || std::regex_search(text, step_pattern) ||
         std::regex_search(text, trailing_names);
}

void RecordHeader::declare(long long number_of_values, double time_step, int line) {
  const auto contradiction = [&](const char* what, const std::string& a, const std::string& b) {
    throw UserError(at_line(file_, line) + "the header says " + what + " " + a + " here and " + b +
                    " before; correct the file");
  };
  if (number_of_values > 0) {
    if (number_of_values_.value_or(number_of_values) != number_of_values)
      contradiction("number of values", std::to_string(number_of_values),
                    std::to_string(*number_of_values_));
    number_of_values_ = number_of_values;
  }
  if (time_step > 0) {
    if (std::abs(time_step_.value_or(time_step) / time_step - 1) > 1e-3)
      contradiction("time step", std::to_string(time_step), std::to_string(*time_step_));
    time_step_ = time_step;
  }
}

void RecordHeader::read(const TextLine& line) {
  const std::string text = line.text.substr(0, longest_header_line);
  const auto value = [](const std::ssub_match& match) {
    return parse_number(match.str()).value_or(0);
  };
  const auto count = [&](const std::ssub_match& match) {
    return match.length() < 10 ? static_cast<long long>(value(match)) : 0;
  };
  std::smatch match;
  if (std::regex_search(text, match, trailing_names)) {
    declare(count(match[1]), value(match[2]), line.number);
  } else {
    if (std::regex_search(text, match, count_pattern)) {
      const auto& group = match[1].matched ? match[1] : (match[2].matched ? match[2] : match[3]);
      declare(count(group), 0, line.number);
    }
    if (std::regex_search(text, match, step_pattern)) {
      const double step = value(match[1]) * (match[2].matched ? 1e-3 : 1);
      if (!(step > 0))
        throw UserError(at_line(file_, line.number) + "time step " + match[1].str() +
                        " is not positive; correct the file");
      declare(0, step, line.number);
    }
    if (std::regex_search(text, match, numbers_in_comment) && value(match[2]) < 1)
      declare(count(match[1]), value(match[2]), line.number);
  }

  auto& units = std::regex_search(text, peak_pattern) ? units_of_peak_ : units_;
  if (std::regex_search(text, cm_pattern)) units.insert("cm/s2");
  if (std::regex_search(text, m_pattern)) units.insert("m/s2");
  if (std::regex_search(text, g_pattern)) units.insert("g");
  if (std::regex_search(text, spectrum_pattern)) spectrum_line_ = line.number;
  acceleration_ = acceleration_ || std::regex_search(text, acceleration_pattern);
  const bool velocity_unit = std::regex_search(text, velocity_unit_pattern);
  const bool other = std::regex_search(text, other_pattern);
  if ((velocity_unit || other) && other_line_ == 0) other_line_ = line.number;
  velocity_unit_ = velocity_unit_ || velocity_unit;
  other_quantity_ = other_quantity_ || other;
}

void RecordHeader::require_acceleration() const {
  if (spectrum_line_ > 0)
    throw UserError(at_line(file_, spectrum_line_) +
                    "the first column is not a time but that of a spectrum; give an accelerogram");
  if (acceleration_ || !(other_quantity_ || (velocity_unit_ && stated_units().empty()))) return;
  throw UserError(at_line(file_, other_line_) +
                  "the header speaks of velocity or displacement, not of acceleration; give an "
                  "accelerogram");
}

double RecordHeader::unit_factor(const std::string& unit) const {
  const auto& stated = stated_units();
  std::string used = unit;
  if (unit.empty()) {
    if (stated.empty())
      throw UserError(file_ + ": the unit is not in the header; give unit: g, m/s2 or cm/s2");
    if (stated.size() > 1)
      throw UserError(file_ + ": the header names several units (" + *stated.begin() + ", " +
                      *stated.rbegin() + "); give unit: g, m/s2 or cm/s2");
    used = *stated.begin();
  } else if (!stated.empty() && !stated.contains(unit)) {
    throw UserError(file_ + ": unit " + unit + " is asked but the header says " + *stated.begin() +
                    "; leave unit out or correct the file");
  }
  if (used == "g") return standard_gravity;
  if (used == "m/s2") return 1;
  if (used == "cm/s2") return 0.01;
  throw UserError(file_ + ": unknown unit " + used + "; give g, m/s2 or cm/s2");
}

}  // namespace pounding
