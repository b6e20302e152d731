#include "motion/record_header.h"

#include <cmath>
#include <regex>

#include "common/error.h"
#include "motion/acceleration_limits.h"

namespace pounding {

namespace {

constexpr std::size_t longest_header_line = 400;
constexpr auto flags = std::regex::ECMAScript | std::regex::icase;

const std::string number = R"(([-+]?(?:\d+\.?\d*|\.\d+)(?:[ED][-+]?\d+)?))";
const std::string gap = R"([\s"',:=]*)";
const std::string squared = R"(\s*/\s*S(?:EC)?\s*(?:/\s*S(?:EC)?|\^?\s*2|\*\*\s*2))";

// NPTS= 4000 | Total No. of Points :",2000 | 3000 points of accel data
const std::regex count_pattern("\\bNPTS" + gap + number + "|\\bNO\\.? OF POINTS" + gap + number +
                                   R"(|(\d+)\s+POINTS\s+(?:OF|AT)\b)",
                               flags);
// NPTS= ****
const std::regex no_number_pattern(R"(\b(NPTS|DT)\s*[=:]\s*(?![-+.\d\s"',]))", flags);
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

void RecordHeader::contradiction(int line, const char* what, const std::string& here,
                                 const std::string& before) const {
  throw UserError(at_line(file_, line) + "the header says " + what + " " + here + " here and " +
                  before + " before; correct the file");
}

void RecordHeader::declare_count(double number_of_values, int line) {
  constexpr double most = 1e9;
  if (!(number_of_values >= 2 && number_of_values <= most) ||
      number_of_values != std::floor(number_of_values)) {
    throw UserError(at_line(file_, line) + "the header announces " + text_of(number_of_values) +
                    " values, which cannot be; correct the file");
  }
  const auto count = static_cast<long long>(number_of_values);
  if (number_of_values_.value_or(count) != count) {
    contradiction(line, "number of values", std::to_string(count),
                  std::to_string(*number_of_values_));
  }
  number_of_values_ = count;
}

void RecordHeader::declare_time_step(double time_step, int line) {
  if (!(time_step > 0)) {
    throw UserError(at_line(file_, line) + "time step " + text_of(time_step) +
                    " is not positive; correct the file");
  }
  if (std::abs(time_step_.value_or(time_step) / time_step - 1) > 1e-3) {
    contradiction(line, "time step", std::to_string(time_step), std::to_string(*time_step_));
  }
  time_step_ = time_step;
}

void RecordHeader::read_sampling(const std::string& text, int line) {
  const auto value = [](const std::ssub_match& match) {
    return parse_number(match.str()).value_or(0);
  };
  std::smatch match;
  if (std::regex_search(text, match, no_number_pattern)) {
    throw UserError(at_line(file_, line) + "no number behind " + match[1].str() +
                    "; correct the file");
  }
  if (std::regex_search(text, match, trailing_names)) {
    declare_count(value(match[1]), line);
    declare_time_step(value(match[2]), line);
    return;
  }
  if (std::regex_search(text, match, count_pattern)) {
    const auto& group = match[1].matched ? match[1] : (match[2].matched ? match[2] : match[3]);
    declare_count(value(group), line);
  }
  if (std::regex_search(text, match, step_pattern)) {
    declare_time_step(value(match[1]) * (match[2].matched ? 1e-3 : 1), line);
  }
  if (std::regex_search(text, match, numbers_in_comment) && value(match[2]) > 0 &&
      value(match[2]) < 1) {
    declare_count(value(match[1]), line);
    declare_time_step(value(match[2]), line);
  }
}

void RecordHeader::read(const TextLine& line) {
  const std::string text = line.text.substr(0, longest_header_line);
  read_sampling(text, line.number);

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
  if (spectrum_line_ > 0) {
    throw UserError(at_line(file_, spectrum_line_) +
                    "the first column is not a time but that of a spectrum; give an accelerogram");
  }
  if (acceleration_ || !(other_quantity_ || (velocity_unit_ && stated_units().empty()))) return;
  throw UserError(at_line(file_, other_line_) +
                  "the header speaks of velocity or displacement, not of acceleration; give an "
                  "accelerogram");
}

RecordUnit RecordHeader::unit(const std::string& asked) const {
  const auto& stated = stated_units();
  std::string used = asked;
  if (asked.empty()) {
    if (stated.empty()) {
      throw UserError(file_ + ": the unit is not in the header; give unit: g, m/s2 or cm/s2");
    }
    if (stated.size() > 1) {
      throw UserError(file_ + ": the header names several units (" + *stated.begin() + ", " +
                      *stated.rbegin() + "); give unit: g, m/s2 or cm/s2");
    }
    used = *stated.begin();
  } else if (!stated.empty() && !stated.contains(asked)) {
    throw UserError(file_ + ": unit " + asked + " is asked but the header says " + *stated.begin() +
                    "; leave unit out or correct the file");
  }
  if (used == "g") return {used, standard_gravity};
  if (used == "m/s2") return {used, 1};
  if (used == "cm/s2") return {used, 0.01};
  throw UserError(file_ + ": unknown unit " + used + "; give g, m/s2 or cm/s2");
}

}  // namespace pounding
