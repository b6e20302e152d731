#include "motion/records/record_header.h"

#include <cctype>
#include <cmath>
#include <regex>

#include "common/error.h"
#include "motion/records/record_format.h"
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

// The values begin at the first row of numbers, but never above a line that declares the sampling.
std::size_t first_row(const std::vector<TextLine>& lines) {
  std::size_t first = lines.size();
  int run = 0;
  for (std::size_t i = 0; i < lines.size() && run < 3; ++i) {
    const bool numbers = !is_comment(lines[i].text) && parse_row(lines[i]).has_value();
    run = numbers ? run + 1 : 0;
    if (numbers && first == lines.size()) first = i;
    if (!numbers && RecordHeader::declares_sampling(lines[i].text)) first = lines.size();
  }
  return first;
}

// A line such as `0.01, abc` just above the values is one of them gone wrong, not a header.
void refuse_spoilt_first_row(const std::string& file, const TextLine& line, std::size_t columns,
                             bool below_sampling) {
  if (is_comment(line.text) || line.text.find('"') != std::string::npos ||
      RecordHeader::declares_sampling(line.text)) {
    return;
  }
  const auto words = split_words(line.text);
  const auto number_like = [](std::string_view word) {
    std::string lower;
    for (const char c : word.substr(0, 5)) {
      if (c != '-' && c != '+') lower += static_cast<char>(std::tolower(c));
    }
    return parse_number(word) || lower == "nan" || lower == "inf";
  };
  const std::string_view text = line.text;
  const auto begin = text.find_first_not_of(" \t");
  const auto first = text.substr(begin, text.find_first_of(" \t", begin) - begin);
  const bool starts_as_one = number_like(words[0]) || number_like(first);
  const bool same_size = words.size() == columns;
  if (starts_as_one && (below_sampling || same_size)) {
    throw UserError(at_line(file, line.number) + "'" + first_bad_word(line.text) +
                    "' is not a finite number; correct it");
  }
}

// Words of a sentence rather than a number gone wrong.
bool is_title(std::string_view text) {
  int words = 0, letters = 0;
  for (const char c : text) {
    letters = std::isalpha(static_cast<unsigned char>(c)) != 0 ? letters + 1 : 0;
    if (letters == 3) ++words;
  }
  return words >= 2;
}

[[noreturn]] void refuse_title(const std::string& file, const TextLine& line,
                               const NumberRow& first) {
  throw UserError(at_line(file, line.number) + "a line of words ('" + line.text.substr(0, 40) +
                  "') below numbers: those from line " + std::to_string(first.line) +
                  " to it seem to be of a header, not the record's; give the values alone, or a " +
                  "format that docs/reference/records.md lists");
}

void read_rows(const std::string& file, const std::vector<TextLine>& lines, std::size_t begin,
               RecordContent& content) {
  long long count = 0;
  int blank = 0;
  for (std::size_t i = begin; i < lines.size(); ++i) {
    const TextLine& line = lines[i];
    if (line.text.empty()) {
      if (blank == 0) blank = line.number;
      continue;
    }
    if (is_comment(line.text)) continue;
    auto row = parse_row(line);
    if (!row) {
      // Another block (the velocity of a corrected record) may follow the announced values.
      if (count > 0 && content.header.number_of_values() == count) return;
      const bool numbers_below = i + 1 < lines.size() && parse_row(lines[i + 1]).has_value();
      if (content.rows.size() > 1 && numbers_below && is_title(line.text)) {
        refuse_title(file, line, content.rows[0]);
      }
      throw UserError(at_line(file, line.number) + "'" + first_bad_word(line.text) +
                      "' is not a finite number; correct it or remove the line");
    }
    if (blank > 0) throw UserError(at_line(file, blank) + "empty line among the values; remove it");
    count += static_cast<long long>(row->values.size());
    content.rows.push_back(std::move(*row));
  }
}

bool is_whole(double value) {
  return value == std::floor(value);
}

// A first row of its own kind: `npts dt`, `npts`, or `dt scale` with a time step known elsewhere.
void take_sampling_row(const std::string& file, double time_step_option, RecordContent& content) {
  if (content.rows.size() < 2) return;
  const NumberRow row = content.rows[0];
  const std::size_t size = row.values.size(), next = content.rows[1].values.size();
  if (size == next || size > 2) return;
  const double first = row.values[0], last = row.values[size - 1];
  const double known = content.header.time_step().value_or(time_step_option);
  const bool counts = is_whole(first) && first >= 2 && first < 1e9;
  if (counts && (size == 1 || (last > 0 && last < 1))) {
    content.header.declare_count(first, row.line);
    if (size == 2) content.header.declare_time_step(last, row.line);
  } else if (!(size == 2 && known > 0 && std::abs(first / known - 1) < 1e-3)) {
    throw UserError(at_line(file, row.line) + std::to_string(size) +
                    " numbers where the next line has " + std::to_string(next) +
                    "; complete or remove the line");
  }
  content.rows.erase(content.rows.begin());
}

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
  const auto count = static_cast<long long>(count_of(file_, line, number_of_values));
  if (number_of_values_.value_or(count) != count) {
    contradiction(line, "number of values", std::to_string(count),
                  std::to_string(*number_of_values_));
  }
  number_of_values_ = count;
}

void RecordHeader::declare_time_step(double time_step, int line) {
  refuse_if(!(time_step > 0), at_line(file_, line) + "time step " + text_of(time_step) +
                                  " is not positive; correct the file");
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
  refuse_if(!name.empty(),
            at_line(file_, line) + "no number behind " + name + "; correct the file");
  const StatedSampling stated = read_sampling(text);
  if (stated.count) declare_count(*stated.count, line);
  if (stated.time_step) declare_time_step(*stated.time_step, line);
  if (!stated.rate) return;
  refuse_if(!(*stated.rate > 0), at_line(file_, line) + "sampling rate " + text_of(*stated.rate) +
                                     " is not positive; correct the file");
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

void RecordHeader::require_acceleration(bool displacement) const {
  refuse_if(spectrum_line_ > 0,
            at_line(file_, spectrum_line_) +
                "the first column is not a time but that of a spectrum; give an accelerogram");
  refuse_if(counts_line_ > 0,
            at_line(file_, counts_line_) +
                "the values are counts of a recorder, or want a factor; multiply them and take "
                "this line out, or give a format that docs/reference/records.md lists");
  if (displacement) {
    if (!velocity_unit_ && (other_quantity_ || !acceleration_)) return;
    throw UserError(file_ +
                    ": the header speaks of acceleration or velocity and a unit of displacement is "
                    "given; correct one of the two");
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
  refuse_if(asked.empty(), file_ + ": the unit is not in the header; give unit: " + units_to_ask);
  return agreed_unit(file_, asked, asked);
}

RecordContent read_record_content(const std::string& file, const std::vector<TextLine>& lines,
                                  double time_step_option, bool of_displacement) {
  const std::size_t begin = first_row(lines);
  RecordContent content{RecordHeader(file), {}, {}};
  for (std::size_t i = 0; i < begin; ++i) content.header.read(lines[i]);
  content.header.require_acceleration(of_displacement);
  read_rows(file, lines, begin, content);
  refuse_if(content.rows.empty(),
            file + ": holds no line of numbers; give a file of acceleration values");
  const std::size_t columns = content.rows.back().values.size();
  for (std::size_t i = begin; i-- > 0;) {
    if (lines[i].text.find_first_not_of(" \t-+=_|*") == std::string::npos) continue;  // a rule
    refuse_spoilt_first_row(file, lines[i], content.rows[0].values.size(),
                            content.header.number_of_values().has_value());
    std::string_view names = lines[i].text;
    if (is_comment(names)) names.remove_prefix(names.find_first_not_of("%;#!* \t"));
    const bool says = names.find_first_of(":=") != std::string_view::npos;  // "units: g" names none
    for (const auto name : split_words(says ? "" : names)) content.names.emplace_back(name);
    break;
  }
  if (content.names.size() != columns) content.names.clear();
  take_sampling_row(file, time_step_option, content);
  return content;
}

}  // namespace pounding
