#include <cmath>
#include <regex>

#include "common/error.h"
#include "motion/records/format_parts.h"
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
  channel.unit = lower(stripped(match[4].str()));
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
  if (channel.real_numbers == 0) {
    throw UserError(at_line(file, channel.line) + "no real numbers of a header above");
  }
  const std::vector<double> header = read_block(file, lines, channel.real_numbers, most).values;
  const double step =
      header[milliseconds] != unknown ? header[milliseconds] / 1000 : header[seconds];
  const double duration = step * channel.count;
  if (!(std::abs(duration - channel.seconds) <= 1 + 0.02 * duration)) {
    throw UserError(at_line(file, channel.line) + text_of(channel.count) + " values every " +
                    text_of(step) + " s are no " + text_of(channel.seconds) +
                    " s; correct the file");
  }
  return step;
}

}  // namespace

bool is_cosmos(std::span<const TextLine> lines) {
  return !lines.empty() && is_cosmos_title(lines[0].text);
}

FormatRecord read_cosmos(const RecordedMotion& motion, std::span<const TextLine> lines) {
  const std::vector<CosmosChannel> channels = cosmos_channels(lines);
  if (channels.empty()) {
    throw UserError(motion.file + ": COSMOS without a block of acceleration; give a volume 1 or 2");
  }
  std::vector<std::string> names;
  for (const CosmosChannel& one : channels) names.push_back(one.name);
  const CosmosChannel& one = channels[choose_component(motion, names)];
  const auto units = units_in("(" + stripped(one.unit.substr(0, one.unit.find('('))) + ")");
  if (units.size() != 1) {
    throw UserError(at_line(motion.file, one.line) + "values in '" + one.unit +
                    "' (counts are those of a volume 0); give a volume 1 or 2 in g or cm/s2");
  }
  FormatRecord record;
  const std::size_t count = count_of(motion.file, one.line, one.count);
  record.time_step = agreed_step(motion, one.line, step_of(motion.file, lines, one));
  NumberBlock block = read_block(motion.file, lines, one.begin, count);
  require_end(motion.file, lines, block, one.line);
  record.values = std::move(block.values);
  record.unit = *units.begin();
  record.component = one.name;
  record.layout = "COSMOS, block of acceleration";
  return record;
}

}  // namespace pounding
