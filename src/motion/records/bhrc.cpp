#include <regex>

#include "common/error.h"
#include "motion/records/record_format.h"
#include "motion/records/record_sampling.h"

/// BHRC of Iran, volume 1: components one after the other, each of lines of words, rows of whole
/// and of real numbers about the record, and values in G/10, alone or in pairs with their times.
namespace pounding {

namespace {

constexpr std::size_t widest = 16;  // values in a row, which zeros may fill up

struct BhrcComponent {
  std::string name;
  std::size_t begin = 0, end = 0;  ///< lines of numbers
  int line = 0;
  std::optional<double> count, duration;
};

std::vector<BhrcComponent> bhrc_components(std::span<const TextLine> lines) {
  static const std::regex sampling(R"(NO\. OF POINTS\s*=\s*(\d+)\s+DURATION\s*=\s*([\d.]+))");
  std::vector<BhrcComponent> components;
  BhrcComponent next;
  std::smatch match;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string& text = lines[i].text;
    if (text.starts_with("COMP")) next.name = trimmed(text.substr(4, 20));
    if (text.starts_with("NO. OF POINTS")) {
      const std::string head = text.substr(0, 100);
      if (!std::regex_search(head, match, sampling)) continue;
      next.count = parse_number(match[1].str());
      next.duration = parse_number(match[2].str());
      next.line = lines[i].number;
    }
    if (text.find("SECONDS AND G/10") == std::string::npos) continue;
    next.begin = i + 1;
    while (next.begin < lines.size() && !parse_row(lines[next.begin])) ++next.begin;
    next.end = next.begin;
    while (next.end < lines.size() && parse_row(lines[next.end])) ++next.end;
    components.push_back(next);
    i = next.end - 1;
    next = {};
  }
  return components;
}

/// The line behind rows of one length of which the last is shorter.
std::size_t behind_group(std::span<const TextLine> lines, std::size_t begin, std::size_t end) {
  if (begin == end) return end;
  const std::size_t width = parse_row(lines[begin])->values.size();
  while (begin < end && parse_row(lines[begin])->values.size() >= width) ++begin;
  return std::min(begin + 1, end);
}

void take_pairs(const std::string& file, std::span<const TextLine> lines, FormatRecord& record) {
  std::vector<TimeOfLine> times;
  std::vector<double> values;
  for (const TextLine& line : lines) {
    const NumberRow row = *parse_row(line);
    for (std::size_t i = 0; i + 1 < row.values.size(); i += 2) {
      times.push_back({row.values[i], line.number});
      values.push_back(row.values[i + 1]);
    }
  }
  record.values = std::move(values);
  record.time_step = uniform_step(file, times);
}

}  // namespace

bool is_bhrc(std::span<const TextLine> lines) {
  const std::string title = lines.empty() ? "" : lines[0].text.substr(0, 6);
  return (title == "* VOL1" || title.starts_with("*VOL1")) && !bhrc_components(lines).empty();
}

FormatRecord read_bhrc(const RecordedMotion& motion, std::span<const TextLine> lines) {
  const std::vector<BhrcComponent> components = bhrc_components(lines);
  const BhrcComponent& one = components[choose_component(motion, names_of(components))];
  refuse_if(!one.count || !one.duration,
            motion.file + ": no number of points and duration of component " + one.name);
  const std::size_t count = count_of(motion.file, one.line, *one.count);
  const std::size_t begin = behind_group(lines, behind_group(lines, one.begin, one.end), one.end);
  std::size_t numbers = 0;
  for (std::size_t i = begin; i < one.end; ++i) numbers += parse_row(lines[i])->values.size();
  FormatRecord record;
  record.unit = "g/10";
  record.component = one.name;
  record.layout = numbers == 2 * count ? "BHRC, pairs of time and value" : "BHRC, values";
  if (numbers == 2 * count) {
    take_pairs(motion.file, lines.subspan(begin, one.end - begin), record);
  } else if (numbers < count || numbers > count + widest) {
    throw UserError(at_line(motion.file, one.line) + "the header announces " +
                    std::to_string(count) + " values but " + std::to_string(numbers) +
                    " numbers follow those about the record; correct the file");
  } else {
    record.values = read_block(motion.file, lines.first(one.end), begin, count).values;
    record.time_step = *one.duration / static_cast<double>(count);
  }
  record.time_step = agreed_step(motion, one.line, record.time_step);
  return record;
}

}  // namespace pounding
