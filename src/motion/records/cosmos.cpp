#include <algorithm>
#include <cmath>
#include <regex>

#include "common/error.h"
#include "motion/records/record_format.h"
#include "motion/records/record_header.h"

/// COSMOS volumes 1 and 2: channels one after the other, each of lines of words, whole and real
/// numbers about the record, comments, and a block that a line announces.
namespace pounding {
namespace {

constexpr double unknown = -999;

struct CosmosChannel {
  std::string name, quantity, unit;
  std::size_t real_numbers = 0;  ///< their first line; 0: none
  std::size_t begin = 0;         ///< the first line of values
  int line = 0;
  double count = 0, seconds = 0;
};

bool is_cosmos_title(const std::string& text) {
  static const std::regex pattern(R"(\(Format v[\d.]+ with\s+\d+ text lines\))", std::regex::icase);
  return text.find("(Format v") != std::string::npos && std::regex_search(text, pattern);
}

/// 7500 acceleration pts, approx 75 secs, units=cm/sec2 (04), Format=(8F10.5)
bool take_announcement(const TextLine& line, CosmosChannel& channel) {
  static const std::regex pattern(
      R"(^\s*(\d+)\s+(.*?)\s*pts,\s*approx\s*([\d.]+)\s*secs?,\s*units\s*=\s*(.*?),\s*Format)",
      std::regex::icase);
  std::smatch match;
  const std::string text = line.text.substr(0, 200);
  if (text.find("pts") == std::string::npos || !std::regex_search(text, match, pattern)) {
    return false;
  }
  channel.count = parse_number(match[1].str()).value_or(0);
  channel.quantity = lower(match[2].str());
  channel.seconds = parse_number(match[3].str()).value_or(0);
  channel.unit = lower(trimmed(match[4].str()));
  channel.line = line.number;
  return true;
}

std::vector<CosmosChannel> cosmos_channels(std::span<const TextLine> lines) {
  static const std::regex name(R"(^Sta Chan\s*(\d+)\s*:\s*(.*?)\s*(?:\(|Location|$))",
                               std::regex::icase);
  std::vector<CosmosChannel> channels;
  CosmosChannel next;
  std::smatch match;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string& text = lines[i].text;
    if (text.empty() || text.find_first_not_of("0123456789+-. eE") == std::string::npos) continue;
    if (is_cosmos_title(text)) next = {};
    const std::string head = text.substr(0, 120);
    if (head.starts_with("Sta Chan") && std::regex_search(head, match, name)) {
      next.name = "Chan " + match[1].str() + ": " + match[2].str();
    }
    if (lower(head).find("real-header values follow") != std::string::npos) {
      next.real_numbers = i + 1;
    }
    if (!take_announcement(lines[i], next)) continue;
    next.begin = i + 1;
    if (next.quantity.find("acc") != std::string::npos) channels.push_back(next);
  }
  return channels;
}

/// Time step: a real number of the header, in milliseconds, which the duration in words confirms.
double step_of(const std::string& file, std::span<const TextLine> lines,
               const CosmosChannel& channel) {
  constexpr std::size_t most = 100, milliseconds = 61, seconds = 33;
  refuse_if(channel.real_numbers == 0,
            at_line(file, channel.line) + "no real numbers of a header above");
  const std::vector<double> header = read_block(file, lines, channel.real_numbers, most).values;
  const double step =
      header[milliseconds] != unknown ? header[milliseconds] / 1000 : header[seconds];
  const double duration = step * channel.count;
  refuse_if(!(std::abs(duration - channel.seconds) <= 1 + 0.02 * duration),
            at_line(file, channel.line) + text_of(channel.count) + " values every " +
                text_of(step) + " s are no " + text_of(channel.seconds) + " s; correct the file");
  return step;
}

/// CSMIP volumes 1 and 2 (also CDMG, CESMD): channels one after the other, each of lines of words,
/// rows of numbers about the record, and blocks that a line announces: acceleration, and of
/// volume 2 velocity and displacement.

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
      next.name = "Chan " + match[1].str() + ": " + trimmed(match[2].str());
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

/// SMC of the USGS: 11 lines of words, 48 whole and 50 real numbers, comments, and values in cm/s2
/// of 8E10.4, which touch.

constexpr std::size_t texts = 11, whole_lines = 6, real_lines = 10;
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
  for (std::size_t i = 0; i < std::min(texts, lines.size()); ++i) {
    const std::string text = lines[i].text.substr(0, 200);
    if (std::regex_search(text, match, pattern)) return match[1].str();
  }
  constexpr std::size_t azimuth = 13;
  return whole[azimuth] == no_whole ? "" : text_of(whole[azimuth]);
}

}  // namespace

bool is_cosmos(std::span<const TextLine> lines) {
  return !lines.empty() && is_cosmos_title(lines[0].text);
}

FormatRecord read_cosmos(const RecordedMotion& motion, std::span<const TextLine> lines) {
  const std::vector<CosmosChannel> channels = cosmos_channels(lines);
  refuse_if(channels.empty(),
            motion.file + ": COSMOS without a block of acceleration; give a volume 1 or 2");
  const CosmosChannel& one = channels[choose_component(motion, names_of(channels))];
  const auto units = units_in("(" + trimmed(one.unit.substr(0, one.unit.find('('))) + ")");
  refuse_if(units.size() != 1,
            at_line(motion.file, one.line) + "values in '" + one.unit +
                "' (counts are those of a volume 0); give a volume 1 or 2 in g or cm/s2");
  const std::size_t count = count_of(motion.file, one.line, one.count);
  const double step = agreed_step(motion, one.line, step_of(motion.file, lines, one));
  NumberBlock block = read_block(motion.file, lines, one.begin, count);
  require_end(motion.file, lines, block, one.line);
  return {std::move(block.values), step, *units.begin(), one.name, "COSMOS, block of acceleration"};
}

bool is_csmip(std::span<const TextLine> lines) {
  const bool titled = !lines.empty() &&
                      lower(lines[0].text.substr(0, 60)).find("accelerogram") != std::string::npos;
  return titled && !csmip_channels(lines, head_lines).empty();
}

FormatRecord read_csmip(const RecordedMotion& motion, std::span<const TextLine> lines) {
  const std::vector<CsmipChannel> channels = csmip_channels(lines, lines.size());
  const CsmipChannel& one = channels[choose_component(motion, names_of(channels))];
  refuse_if(one.unit.empty(),
            at_line(motion.file, one.line) + "no unit, or several, behind the time step");
  const std::size_t count = count_of(motion.file, one.line, one.count.value_or(0));
  const double step = agreed_step(motion, one.line, one.step.value_or(0));
  NumberBlock block = read_block(motion.file, lines, one.begin, count);
  require_end(motion.file, lines, block, one.line);
  if (one.peak && one.unit == "cm/s2") {
    require_peak(motion.file, one.peak_line, *one.peak, block.values);
  }
  return {std::move(block.values), step, one.unit, one.name, "CSMIP, block of acceleration"};
}

bool is_smc(std::span<const TextLine> lines) {
  return lines.size() > 1 && is_smc_title(lines[0].text) && lines[1].text.starts_with("*");
}

FormatRecord read_smc(const RecordedMotion& motion, std::span<const TextLine> lines) {
  const std::string title = trimmed(lines[0].text);
  refuse_if(
      title.find("ACCELEROGRAM") == std::string::npos,
      at_line(motion.file, 1) + "SMC of kind '" + title + "'; give one of acceleration (1 or 2)");
  const std::vector<double> whole = read_block(motion.file, lines, texts, 8 * whole_lines).values;
  const std::vector<double> real =
      read_block(motion.file, lines, texts + whole_lines, 5 * real_lines).values;
  constexpr std::size_t comments = 15, count_at = 16, rate = 1, largest = 29, smallest = 31;
  const auto line_of = [&](std::size_t at) { return lines[std::min(at, lines.size() - 1)].number; };
  refuse_if(!(real[rate] > 0 && real[rate] < largest_real),
            at_line(motion.file, line_of(texts + whole_lines)) +
                "SMC without a sampling rate: pairs of time and value at no uniform step; "
                "resample them");
  choose_component(motion, {component_of(lines, whole)});
  const std::size_t count = count_of(motion.file, line_of(texts), whole[count_at]);
  std::size_t begin = texts + whole_lines + real_lines;
  while (begin < lines.size() && lines[begin].text.starts_with("|")) ++begin;
  const auto told = static_cast<double>(begin - texts - whole_lines - real_lines);
  refuse_if(whole[comments] != no_whole && whole[comments] != told,
            at_line(motion.file, line_of(begin)) + text_of(told) +
                " lines of comments where the header announces " + text_of(whole[comments]) +
                "; correct the file");
  const double step = agreed_step(motion, line_of(texts + whole_lines), 1 / real[rate]);
  NumberBlock block = read_block(motion.file, lines, begin, count);
  if (std::abs(real[largest]) < largest_real && std::abs(real[smallest]) < largest_real) {
    require_peak(motion.file, line_of(texts + whole_lines),
                 std::max(std::abs(real[largest]), std::abs(real[smallest])), block.values);
  }
  return {std::move(block.values), step, "cm/s2", component_of(lines, whole),
          "SMC, " + lower(title.substr(2))};
}

}  // namespace pounding
