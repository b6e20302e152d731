#include <regex>

#include "common/error.h"
#include "motion/records/format_parts.h"
#include "motion/records/record_header.h"

/// CSMIP volumes 1 and 2 (also CDMG, CESMD): channels one after the other, each of lines of words,
/// rows of numbers about the record, and blocks that a line announces: acceleration, and of
/// volume 2 velocity and displacement.
namespace pounding {

namespace {

struct CsmipChannel {
  std::string name;
  std::size_t begin = 0;  ///< the first line of values
  int line = 0, peak_line = 0;
  std::optional<double> count, step, peak;
  std::string unit;
};

// 7500 points of accel data equally spaced at  .010 sec, in cm/sec2. (8f10.6)
bool announces(const std::string& text, std::smatch& match) {
  static const std::regex pattern(
      R"(^\s*(\d+)\s+points\s+of\s+(accel|veloc|displ)\w*\s+data\s+equally\s+spaced\s+at\s*([\d.]+)\s*sec(.*))",
      std::regex::icase);
  return std::regex_search(text, match, pattern);
}

/// Acceleration blocks of a file, with the statements of the words above each.
std::vector<CsmipChannel> csmip_channels(std::span<const TextLine> lines, std::size_t most) {
  static const std::regex name(R"(\bchan(?:nel)?\s*(\d+)\s*:\s*(.*?)(?:\s{2,}|$))",
                               std::regex::icase);
  static const std::regex peak(R"(peak\s+acceleration\s*=\s*([-+\d.]+)\s*(\S*))",
                               std::regex::icase);
  std::vector<CsmipChannel> channels;
  CsmipChannel next;
  std::smatch match;
  for (std::size_t i = 0; i < std::min(lines.size(), most); ++i) {
    if (lines[i].text.find_first_of("cCpP") == std::string::npos) continue;  // rows of numbers
    const std::string text = lines[i].text.substr(0, 200);
    if (std::regex_search(text, match, name)) {
      next.name = "Chan " + match[1].str() + ": " + stripped(match[2].str());
    }
    if (std::regex_search(text, match, peak)) {
      next.peak = parse_number(match[1].str());
      next.peak_line = lines[i].number;
    }
    if (!announces(text, match) || lower(match[2].str()) != "accel") continue;
    next.count = parse_number(match[1].str());
    next.step = parse_number(match[3].str());
    const auto units = units_in(match[4].str());
    next.unit = units.size() == 1 ? *units.begin() : "";
    next.begin = i + 1;
    next.line = lines[i].number;
    channels.push_back(next);
    next.peak.reset();
  }
  return channels;
}

}  // namespace

bool is_csmip(std::span<const TextLine> lines) {
  const bool titled = !lines.empty() &&
                      lower(lines[0].text.substr(0, 60)).find("accelerogram") != std::string::npos;
  return titled && !csmip_channels(lines, head_lines).empty();
}

FormatRecord read_csmip(const RecordedMotion& motion, std::span<const TextLine> lines) {
  const std::vector<CsmipChannel> channels = csmip_channels(lines, lines.size());
  std::vector<std::string> names;
  for (const CsmipChannel& one : channels) names.push_back(one.name);
  const CsmipChannel& one = channels[choose_component(motion, names)];
  if (one.unit.empty()) {
    throw UserError(at_line(motion.file, one.line) + "no unit, or several, behind the time step");
  }
  FormatRecord record;
  const std::size_t count = count_of(motion.file, one.line, one.count.value_or(0));
  record.time_step = agreed_step(motion, one.line, one.step.value_or(0));
  NumberBlock block = read_block(motion.file, lines, one.begin, count);
  require_end(motion.file, lines, block, one.line);
  record.values = std::move(block.values);
  if (one.peak && one.unit == "cm/s2") {
    require_peak(motion.file, one.peak_line, *one.peak, record.values);
  }
  record.unit = one.unit;
  record.component = one.name;
  record.layout = "CSMIP, block of acceleration";
  return record;
}

}  // namespace pounding
