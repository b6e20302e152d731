#include <cmath>
#include <regex>

#include "common/error.h"
#include "motion/records/record_format.h"

/// GeoNet V1A (uncorrected) and V2A (corrected, with velocity and displacement): components one
/// after the other, each of lines of words, rows of numbers about the record, and blocks of values.
namespace pounding {

namespace {

constexpr std::size_t most_words = 24;  // lines of words of a component
constexpr std::size_t whole_rows = 4, real_rows = 6, row_size = 10;

struct GeonetComponent {
  std::string name;
  bool corrected = false;
  std::size_t begin = 0;  ///< the first row about the record
  int title_line = 0, count_line = 0, peak_line = 0;
  std::optional<double> count, step, peak;
};

bool is_geonet_title(const std::string& text) {
  const std::string small = lower(text.substr(0, 30));
  return small.starts_with("corrected accelerogram") ||
         small.starts_with("uncorrected accelerogram");
}

/// The lines of words of a component that begins at line `at`.
GeonetComponent read_words(std::span<const TextLine> lines, std::size_t at) {
  static const std::regex count(R"(^\s*Number of points\s+(\d+))", std::regex::icase);
  static const std::regex step(R"(\bat\s+([\d.]+)\s*sec\s+intervals)", std::regex::icase);
  static const std::regex peak(R"(^\s*Acceleration:?\s+peak\s+([-+\d.]+)\s*mm/s/s)",
                               std::regex::icase);
  static const std::regex name(R"(^\s*Component\s+(\S+))", std::regex::icase);
  GeonetComponent one;
  one.corrected = lower(lines[at].text).starts_with("corrected");
  one.title_line = lines[at].number;
  std::smatch match;
  for (one.begin = at; one.begin < lines.size() && one.begin < at + most_words; ++one.begin) {
    const std::string text = lines[one.begin].text.substr(0, 200);
    const auto row = parse_row(lines[one.begin]);
    if (row && row->values.size() == row_size) return one;
    if (std::regex_search(text, match, count)) {
      one.count = parse_number(match[1].str());
      one.count_line = lines[one.begin].number;
    }
    if (std::regex_search(text, match, step)) one.step = parse_number(match[1].str());
    if (std::regex_search(text, match, name)) one.name = match[1].str();
    if (std::regex_search(text, match, peak)) {
      one.peak = parse_number(match[1].str());
      one.peak_line = lines[one.begin].number;
    }
  }
  one.begin = lines.size();
  return one;
}

std::vector<GeonetComponent> geonet_components(std::span<const TextLine> lines) {
  std::vector<GeonetComponent> components;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!is_geonet_title(lines[i].text)) continue;
    components.push_back(read_words(lines, i));
    if (components.back().name.empty()) components.back().name = "unnamed";
  }
  return components;
}

/// Count and step in the rows about the record, which the words must not contradict.
struct Stated {
  double count = 0, step = 0;
};

Stated read_numbers(const std::string& file, std::span<const TextLine> lines,
                    const GeonetComponent& one) {
  const NumberBlock whole = read_block(file, lines, one.begin, whole_rows * row_size);
  const NumberBlock real = read_block(file, lines, whole.end, real_rows * row_size);
  // of the record as it was taken, and as it was corrected
  constexpr std::size_t raw_count = 30, count = 33, raw_step = 24, step = 25;
  Stated stated{whole.values[one.corrected ? count : raw_count],
                real.values[one.corrected ? step : raw_step]};
  const bool other_count = one.count && *one.count != stated.count;
  const bool other_step = one.step && !(std::abs(*one.step - stated.step) < 0.01 * stated.step);
  refuse_if(other_count || other_step,
            at_line(file, one.title_line) + "the words of the header say " +
                text_of(one.count.value_or(stated.count)) + " points every " +
                text_of(one.step.value_or(stated.step)) + " s, its numbers " +
                text_of(stated.count) + " every " + text_of(stated.step) + " s; correct the file");
  return stated;
}

/// Velocity and displacement, or nothing, lie between the values and the next component.
void require_rest(const std::string& file, std::span<const TextLine> lines, std::size_t begin,
                  std::size_t rows) {
  std::size_t end = begin;
  while (end < lines.size() && parse_row(lines[end])) ++end;
  const bool closed =
      end == lines.size() || lines[end].text.empty() || is_geonet_title(lines[end].text);
  const std::size_t found = end - begin;
  if (closed && (found == 0 || found == rows || found == 2 * rows)) return;
  throw UserError(at_line(file, lines[std::min(end, lines.size() - 1)].number) +
                  std::to_string(found) + " rows below the acceleration, where " +
                  std::to_string(2 * rows) +
                  " of velocity and displacement are expected, or none; correct the file");
}

}  // namespace

bool is_geonet(std::span<const TextLine> lines) {
  if (lines.empty() || !is_geonet_title(lines[0].text)) return false;
  const GeonetComponent first = read_words(lines, 0);
  return first.count && (first.peak || !first.corrected) && first.begin < lines.size();
}

FormatRecord read_geonet(const RecordedMotion& motion, std::span<const TextLine> lines) {
  const std::vector<GeonetComponent> components = geonet_components(lines);
  const GeonetComponent& one = components[choose_component(motion, names_of(components))];
  refuse_if(!one.count || one.begin == lines.size(),
            at_line(motion.file, one.title_line) +
                "no number of points, or no rows of numbers, below this title");
  const Stated stated = read_numbers(motion.file, lines, one);
  const std::size_t count = count_of(motion.file, one.count_line, stated.count);
  const double step = agreed_step(motion, one.title_line, stated.step);
  const std::size_t begin = one.begin + whole_rows + real_rows;
  NumberBlock block = read_block(motion.file, lines, begin, count);
  require_rest(motion.file, lines, block.end, block.end - begin);
  if (one.peak) require_peak(motion.file, one.peak_line, *one.peak, block.values);
  return {std::move(block.values), step, "mm/s2", one.name,
          one.corrected ? "GeoNet, corrected" : "GeoNet, uncorrected"};
}

}  // namespace pounding
