#include <algorithm>
#include <cmath>
#include <regex>

#include "common/error.h"
#include "motion/records/format_parts.h"

/// SMC of the USGS: 11 lines of words, 48 whole and 50 real numbers, comments, and values in cm/s2
/// of 8E10.4, which touch.
namespace pounding {

namespace {

constexpr std::size_t words = 11, whole_lines = 6, real_lines = 10;
constexpr double no_whole = -32768;
constexpr double largest_real = 1e38;  // unknown values are above it

bool is_smc_title(const std::string& text) {
  static const std::regex pattern(
      R"(^\s*[0-6] (UNKNOWN|(UN)?CORRECTED ACCELEROGRAM|VELOCITY|DISPLACEMENT|RESPONSE SPECTRA|FOURIER AMPLITUDE.*)\s*$)");
  return std::regex_search(text.substr(0, 120), pattern);
}

std::string component_of(std::span<const TextLine> lines, const std::vector<double>& whole) {
  static const std::regex pattern(R"(component\s*=\s*(\S+))", std::regex::icase);
  std::smatch match;
  for (std::size_t i = 0; i < std::min(words, lines.size()); ++i) {
    const std::string text = lines[i].text.substr(0, 200);
    if (std::regex_search(text, match, pattern)) return match[1].str();
  }
  constexpr std::size_t azimuth = 13;
  return whole[azimuth] == no_whole ? "" : text_of(whole[azimuth]);
}

}  // namespace

bool is_smc(std::span<const TextLine> lines) {
  return lines.size() > 1 && is_smc_title(lines[0].text) && lines[1].text.starts_with("*");
}

FormatRecord read_smc(const RecordedMotion& motion, std::span<const TextLine> lines) {
  const std::string title = stripped(lines[0].text);
  if (title.find("ACCELEROGRAM") == std::string::npos) {
    throw UserError(at_line(motion.file, 1) + "SMC of kind '" + title +
                    "'; give one of acceleration (1 or 2)");
  }
  const std::vector<double> whole = read_block(motion.file, lines, words, 8 * whole_lines).values;
  const std::vector<double> real =
      read_block(motion.file, lines, words + whole_lines, 5 * real_lines).values;
  constexpr std::size_t comments = 15, count_at = 16, rate = 1, largest = 29, smallest = 31;
  const auto line_of = [&](std::size_t at) { return lines[std::min(at, lines.size() - 1)].number; };
  if (!(real[rate] > 0 && real[rate] < largest_real)) {
    throw UserError(at_line(motion.file, line_of(words + whole_lines)) +
                    "SMC without a sampling rate: pairs of time and value at no uniform step; "
                    "resample them");
  }
  choose_component(motion, {component_of(lines, whole)});
  const std::size_t count = count_of(motion.file, line_of(words), whole[count_at]);
  std::size_t begin = words + whole_lines + real_lines;
  while (begin < lines.size() && lines[begin].text.starts_with("|")) ++begin;
  const auto told = static_cast<double>(begin - words - whole_lines - real_lines);
  if (whole[comments] != no_whole && whole[comments] != told) {
    throw UserError(at_line(motion.file, line_of(begin)) + text_of(told) +
                    " lines of comments where the header announces " + text_of(whole[comments]) +
                    "; correct the file");
  }
  FormatRecord record;
  record.time_step = agreed_step(motion, line_of(words + whole_lines), 1 / real[rate]);
  NumberBlock block = read_block(motion.file, lines, begin, count);
  record.values = std::move(block.values);
  if (std::abs(real[largest]) < largest_real && std::abs(real[smallest]) < largest_real) {
    require_peak(motion.file, line_of(words + whole_lines),
                 std::max(std::abs(real[largest]), std::abs(real[smallest])), record.values);
  }
  record.unit = "cm/s2";
  record.component = component_of(lines, whole);
  record.layout = "SMC, " + lower(title.substr(2));
  return record;
}

}  // namespace pounding
