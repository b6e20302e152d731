#include <map>

#include "common/error.h"
#include "motion/records/record_format.h"
#include "motion/records/record_header.h"

/// ESM, ITACA, AFAD and the like: lines KEY: value, then one column.
namespace pounding {

namespace {

struct Key {
  std::string value;
  int line = 0;
};

struct KeyedHeader {
  std::map<std::string, Key> keys;
  std::size_t end = 0;  ///< the first line of values
};

KeyedHeader read_keyed_header(std::span<const TextLine> lines) {
  KeyedHeader header;
  for (; header.end < lines.size() && header.end < head_lines; ++header.end) {
    const std::string& text = lines[header.end].text;
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos || colon == 0 || parse_row(lines[header.end])) break;
    header.keys[trimmed(text.substr(0, colon))] = {trimmed(text.substr(colon + 1)),
                                                   lines[header.end].number};
  }
  return header;
}

double number_of(const std::string& file, const KeyedHeader& header, const std::string& name) {
  const auto found = header.keys.find(name);
  if (found == header.keys.end()) throw UserError(file + ": the header has no " + name);
  const auto number = parse_number(found->second.value);
  if (!number) {
    throw UserError(at_line(file, found->second.line) + "no number behind " + name +
                    "; correct the file");
  }
  return *number;
}

std::string text_of_key(const KeyedHeader& header, const std::string& name) {
  const auto found = header.keys.find(name);
  return found == header.keys.end() ? "" : found->second.value;
}

}  // namespace

bool is_keyed(std::span<const TextLine> lines) {
  const KeyedHeader header = read_keyed_header(lines);
  return header.keys.contains("SAMPLING_INTERVAL_S") && header.keys.contains("NDATA");
}

FormatRecord read_keyed(const RecordedMotion& motion, std::span<const TextLine> lines) {
  const KeyedHeader header = read_keyed_header(lines);
  const std::string type = lower(text_of_key(header, "DATA_TYPE"));
  if (!type.empty() && type != "acceleration") {
    throw UserError(at_line(motion.file, header.keys.at("DATA_TYPE").line) + "holds '" + type +
                    "', not acceleration (velocity, displacement or a spectrum); give an "
                    "accelerogram");
  }
  const auto units = units_in(text_of_key(header, "UNITS"));
  const std::string in_header = text_of_key(header, "UNITS");
  refuse_if(units.size() != 1 && in_header != "g",
            motion.file + ": UNITS: '" + in_header + "' is no unit of acceleration");
  FormatRecord record;
  record.unit = units.empty() ? "g" : *units.begin();
  record.component = text_of_key(header, "STREAM");
  if (record.component.empty()) record.component = text_of_key(header, "COMPONENT");
  choose_component(motion, {record.component});
  const int step_line = header.keys.at("SAMPLING_INTERVAL_S").line;
  record.time_step =
      agreed_step(motion, step_line, number_of(motion.file, header, "SAMPLING_INTERVAL_S"));
  const std::size_t count =
      count_of(motion.file, header.keys.at("NDATA").line, number_of(motion.file, header, "NDATA"));
  NumberBlock block = read_block(motion.file, lines, header.end, count);
  for (; block.end < lines.size(); ++block.end) {
    const TextLine& line = lines[block.end];
    if (line.text.empty()) continue;
    throw UserError(at_line(motion.file, line.number) + "the header announces " +
                    std::to_string(count) + " values but there are more; correct the file");
  }
  record.values = std::move(block.values);
  const auto peak = parse_number(text_of_key(header, "PGA_CM/S^2"));
  if (peak && record.unit == "cm/s2") {
    require_peak(motion.file, header.keys.at("PGA_CM/S^2").line, *peak, record.values);
  }
  record.layout = "keys and one column (ESM, ITACA, AFAD)";
  return record;
}

}  // namespace pounding
