#include "motion/records/record_content.h"

#include <cctype>
#include <cmath>

#include "common/error.h"

namespace pounding {

namespace {

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
                  "format that docs/records.md lists");
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

RecordContent read_record_content(const std::string& file, const std::vector<TextLine>& lines,
                                  double time_step_option) {
  const std::size_t begin = first_row(lines);
  RecordContent content{RecordHeader(file), {}, {}};
  for (std::size_t i = 0; i < begin; ++i) content.header.read(lines[i]);
  content.header.require_acceleration();
  read_rows(file, lines, begin, content);
  if (content.rows.empty()) {
    throw UserError(file + ": holds no line of numbers; give a file of acceleration values");
  }
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
