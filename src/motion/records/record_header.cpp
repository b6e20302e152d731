#include "motion/records/record_header.h"

#include <cmath>
#include <regex>

#include "common/error.h"
#include "motion/records/record_sampling.h"

namespace pounding {

namespace {

constexpr std::size_t longest_header_line = 400;
constexpr auto flags = std::regex::ECMAScript | std::regex::icase;

const std::string squared = R"(\s*/\s*S(?:EC)?\s*(?:/\s*S(?:EC)?|\^?\s*2|\*\*\s*2))";

const std::regex mm_pattern("\\bMM" + squared, flags);
const std::regex cm_pattern("\\bCM" + squared + R"(|\bGALS?\b)", flags);
const std::regex m_pattern("(?:^|[^A-Z])M" + squared, flags);
const std::regex tenth_pattern(R"(\bG\s*/\s*10\b)", flags);
const std::regex g_pattern(R"([(\[]\s*G\s*[)\]]|\bUNITS?\s*(?:OF|ARE|IS|IN)?[\s:="]*G\b(?!\s*/))"
                           R"(|\bIN\s+G\b(?!\s*/))",
                           flags);
const std::regex velocity_unit_pattern(R"(\b[CM]?M\s*/\s*S(?:EC)?\b(?!\s*(?:/|\^|\*|2)))", flags);
const std::regex peak_pattern(R"(\b(?:PEAK|MAX(?:IMUM)?|PGA)\b)", flags);
const std::regex acceleration_pattern(R"((?:^|[^A-Z])(?:ACC|ACEL|BESCHL))", flags);
const std::regex other_pattern(
    R"((?:^|[^A-Z])(?:VEL(?:[^A-Z]|$)|VELOC|DISPL?(?:[^A-Z]|ACEM|$)|DESPLAZ|GESCHW|VERSCH))",
    flags);
const std::regex spectrum_pattern(R"(^\W*(?:PERIODS?\b|FREQ(?:UENCY)?\s*[\[(,;]))", flags);
// units: counts | Units = raw counts(50) | UNIDADES: cuentas
const std::regex counts_pattern(
    R"(\b(?:UNITS?|UNIDADES)\b[^A-Z]*(?:(?:ARE|IN|OF|RAW|DIGITAL)\s*)*(?:COUNTS?|CUENTAS)\b)",
    flags);
// Scale Factor 3920(gal)/6182761
const std::regex scale_pattern(R"(\bSCALE\s*FACTOR[\s:=]*([-+.\d][-+.\dED]*))", flags);

// COMP N10E | Component: 090 | Dir. E-W | STREAM: HNE | Chan  1: 90 Deg
const std::regex component_pattern(
    R"((?:^|[\s,;#%])(?:COMP(?:ONENT)?|DIR|STREAM|CHAN(?:NEL)?\s*\d+)\s*(?:[.:=]\s*|\s+))"
    R"((\d{1,3}(?:\.\d+)?(?:\s*DEG)?|[NS]\d{1,2}[EW]|N-?S|E-?W|U-?D|[NSEWUDVZLTRXYH]\d?)"
    R"(|[BEHS][HNL][ENZ123]|UP|DOWN|VERT[A-Z]*|LONG[A-Z]*|TRANS[A-Z]*)(?![-A-Z0-9]))",
    flags);
// A PLACE, 1/17/94, SOMEWHERE STATION, 228
const std::regex last_word_pattern(
    R"(\d+/\d+/\d+.*,\s*(\d{1,3}|UP|DOWN|DWN|VERT|[NS]\d{1,2}[EW]|[NSEWVZ])\s*(?:\([^)]*\))?\s*$)",
    flags);

}  // namespace

std::set<std::string> units_in(const std::string& text) {
  std::set<std::string> units;
  if (std::regex_search(text, mm_pattern)) units.insert("mm/s2");
  if (std::regex_search(text, cm_pattern)) units.insert("cm/s2");
  if (std::regex_search(text, m_pattern)) units.insert("m/s2");
  if (std::regex_search(text, tenth_pattern)) units.insert("g/10");
  if (std::regex_search(text, g_pattern)) units.insert("g");
  return units;
}

std::string component_in(const std::string& text) {
  std::smatch match;
  const bool named = std::regex_search(text, match, component_pattern) ||
                     std::regex_search(text, match, last_word_pattern);
  return named ? match[1].str() : "";
}

bool RecordHeader::declares_sampling(const std::string& line) {
  return read_sampling(line.substr(0, longest_header_line)).any();
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

std::optional<double> RecordHeader::time_step() const {
  if (time_step_ || rates_differ_) return time_step_;
  return step_of_rate_;
}

void RecordHeader::take_sampling(const std::string& text, int line) {
  const std::string name = name_without_number(text);
  if (!name.empty()) {
    throw UserError(at_line(file_, line) + "no number behind " + name + "; correct the file");
  }
  const StatedSampling stated = read_sampling(text);
  if (stated.count) declare_count(*stated.count, line);
  if (stated.time_step) declare_time_step(*stated.time_step, line);
  if (!stated.rate) return;
  if (!(*stated.rate > 0)) {
    throw UserError(at_line(file_, line) + "sampling rate " + text_of(*stated.rate) +
                    " is not positive; correct the file");
  }
  const double step = 1 / *stated.rate;
  rates_differ_ = rates_differ_ || std::abs(step_of_rate_.value_or(step) / step - 1) > 1e-3;
  step_of_rate_ = step;
}

void RecordHeader::read(const TextLine& line) {
  const std::string text = line.text.substr(0, longest_header_line);
  take_sampling(text, line.number);

  auto& units = std::regex_search(text, peak_pattern) ? units_of_peak_ : units_;
  units.merge(units_in(text));
  if (component_.empty()) component_ = component_in(text);
  std::smatch scale;
  if (std::regex_search(text, counts_pattern) ||
      (std::regex_search(text, scale, scale_pattern) && parse_number(scale[1].str()) != 1.0)) {
    counts_line_ = line.number;
  }
  if (std::regex_search(text, spectrum_pattern)) spectrum_line_ = line.number;
  acceleration_ = acceleration_ || std::regex_search(text, acceleration_pattern);
  const std::string quantities = without_rate(text);
  const bool velocity_unit = std::regex_search(quantities, velocity_unit_pattern);
  const bool other = std::regex_search(quantities, other_pattern);
  if ((velocity_unit || other) && other_line_ == 0) other_line_ = line.number;
  velocity_unit_ = velocity_unit_ || velocity_unit;
  other_quantity_ = other_quantity_ || other;
}

void RecordHeader::require_acceleration() const {
  if (spectrum_line_ > 0) {
    throw UserError(at_line(file_, spectrum_line_) +
                    "the first column is not a time but that of a spectrum; give an accelerogram");
  }
  if (counts_line_ > 0) {
    throw UserError(at_line(file_, counts_line_) +
                    "the values are counts of a recorder, or want a factor; multiply them and take "
                    "this line out, or give a format that docs/records.md lists");
  }
  if (acceleration_ || !(other_quantity_ || (velocity_unit_ && stated_units().empty()))) return;
  throw UserError(at_line(file_, other_line_) +
                  "the header speaks of velocity or displacement, not of acceleration; give an "
                  "accelerogram");
}

RecordUnit RecordHeader::unit(const std::string& asked) const {
  const auto& stated = stated_units();
  if (stated.contains(asked)) return agreed_unit(file_, asked, asked);
  if (stated.size() == 1) return agreed_unit(file_, asked, *stated.begin());
  if (stated.size() > 1) {
    throw UserError(file_ + ": the header names several units (" + *stated.begin() + ", " +
                    *stated.rbegin() + "); give unit: " + units_to_ask);
  }
  if (asked.empty()) {
    throw UserError(file_ + ": the unit is not in the header; give unit: " + units_to_ask);
  }
  return agreed_unit(file_, asked, asked);
}

}  // namespace pounding
