#include "motion/records/record_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "common/error.h"
#include "common/finite_file.h"

namespace pounding {

namespace {


constexpr std::string_view blanks = " \t\r\f\v";

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// The kind of file that bytes which are no text begin like: " but miniSEED", or "".
std::string kind_of_bytes(std::string_view bytes) {
  struct Kind {
    std::string_view beginning;
    const char* name;
  };
  static constexpr std::array kinds{Kind{"\x89HDF", "an HDF5 file"},
                                    Kind{"PK\x03\x04", "a zip archive or a spreadsheet"},
                                    Kind{"\x1f\x8b", "packed by gzip"},
                                    Kind{"%PDF", "a PDF"},
                                    Kind{"\xd0\xcf\x11\xe0", "an old spreadsheet"},
                                    Kind{"\xff\xfe", "text in UTF-16"},
                                    Kind{"\xfe\xff", "text in UTF-16"}};
  for (const Kind& kind : kinds) {
    if (bytes.starts_with(kind.beginning)) return std::string(" but ") + kind.name;
  }
  const bool sequence =
      bytes.size() > 8 && std::string_view("DRQM").find(bytes[6]) < 4 &&
      std::all_of(bytes.begin(), bytes.begin() + 6, [](char c) { return c >= '0' && c <= '9'; });
  return sequence ? " but miniSEED" : "";
}

// Values of equal width and number of decimals, such as 8F10.3, may follow one another without a
// blank: the distance between the decimal points is then the width.
std::optional<std::vector<double>> parse_fixed_width(std::string_view text) {
  const auto first = text.find('.');
  if (first == std::string_view::npos) return {};
  const auto second = text.find('.', first + 1);
  if (second == std::string_view::npos) return {};
  const std::size_t width = second - first;
  if (first >= width || text.size() % width != 0) return {};
  std::vector<double> values;
  for (std::size_t i = 0; i < text.size(); i += width) {
    const auto field = text.substr(i, width);
    const auto value = parse_number(trim(field));
    if (field.find('.') != first || field.back() == ' ' || !value) return {};
    values.push_back(*value);
  }
  return values;
}

}  // namespace

std::string text_of(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.8g", value);
  return buffer;
}

std::string at_line(const std::string& file, int line) {
  return file + ":" + std::to_string(line) + ": ";
}

std::vector<TextLine> read_text_lines(const std::string& file) {
  require_finite_file(file, "", largest_text);
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw UserError(file + ": cannot be opened; check the path and the permissions");
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  if (text.find('\0') != std::string::npos) {
    throw UserError(file + ": is not a text file" + kind_of_bytes(text) + "; export it as text");
  }
  if (text.find('\n') == std::string::npos) std::replace(text.begin(), text.end(), '\r', '\n');

  std::vector<TextLine> lines;
  bool empty = true;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = text.substr(begin, end - begin);
    line.erase(line.find_last_not_of(blanks) + 1);
    empty = empty && line.empty();
    lines.push_back({static_cast<int>(lines.size()) + 1, std::move(line)});
    begin = end + 1;
  }
  if (empty) throw UserError(file + ": is empty; give a file with values");
  return lines;
}

bool is_comment(std::string_view text) {
  const auto first = text.find_first_not_of(blanks);
  return first != std::string_view::npos &&
         std::string_view("%;#!*").find(text[first]) != std::string_view::npos;
}

std::optional<double> parse_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  std::string text(word);
  if (text.empty() || text.front() == '+') return {};
  for (char& c : text) {
    if (c == 'D' || c == 'd') c = 'e';
  }
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

std::vector<std::string_view> split_words(std::string_view text) {
  std::vector<std::string_view> words;
  text = trim(text);
  if (text.empty()) return words;
  if (text.find_first_of(",;") != std::string_view::npos) {
    const char delimiter = text.find(',') != std::string_view::npos ? ',' : ';';
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find(delimiter, begin), text.size());
      words.push_back(trim(text.substr(begin, end - begin)));
      begin = end + 1;
    }
    return words;
  }
  for (std::size_t begin = 0; begin != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(blanks, end);
  }
  return words;
}

/// Digits behind the points of the numbers of a line; -1 where they differ.
int decimals_in(std::string_view text) {
  int common = -2, here = 0;
  bool point = false, number = false, exponent = false;
  const auto end_word = [&] {
    if (number) common = common == -2 || common == here ? here : -1;
    here = 0;
    point = number = exponent = false;
  };
  for (const char c : text) {
    const bool digit = c >= '0' && c <= '9';
    if (digit && !exponent) {
      number = true;
      here += point ? 1 : 0;
    } else if (c == '.' && !point) {
      point = true;
    } else if (number && std::string_view("eEdD").find(c) != std::string_view::npos) {
      exponent = true;
    } else if (!digit && !(exponent && (c == '-' || c == '+'))) {
      end_word();
      point = c == '.';
    }
  }
  end_word();
  return std::max(common, -1);
}

std::optional<NumberRow> parse_row(const TextLine& line) {
  NumberRow row;
  row.line = line.number;
  row.delimited = line.text.find_first_of(",;") != std::string::npos;
  bool numbers = true;
  for (const auto word : split_words(line.text)) {
    const auto value = parse_number(word);
    if (!value) {
      numbers = false;
      break;
    }
    row.values.push_back(*value);
  }
  if (!numbers) {
    auto values = parse_fixed_width(line.text);
    if (!values) return {};
    row.values = std::move(*values);
  }
  if (row.values.empty()) return {};
  row.decimals = decimals_in(line.text);
  return row;
}

std::string first_bad_word(std::string_view text) {
  for (const auto word : split_words(text)) {
    if (!parse_number(word)) return std::string(word.substr(0, 40));
  }
  return {};
}

}  // namespace pounding
