#include "motion/records/record_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "common/error.h"

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

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// A word of a line of numbers, split at its commas.
struct Word {
  std::string_view whole;     ///< before the comma
  std::string_view decimals;  ///< digits behind it; empty where there is no comma
  bool comma = false;
};

/// [-+]digits[,digits][E[-+]digits]; nothing for another word.
std::optional<Word> read_word(std::string_view text) {
  std::size_t i = 0;
  if (i < text.size() && (text[i] == '-' || text[i] == '+')) ++i;
  while (i < text.size() && is_digit(text[i])) ++i;
  Word word{text.substr(0, i), {}, false};
  if (i < text.size() && text[i] == ',') {
    const std::size_t begin = ++i;
    while (i < text.size() && is_digit(text[i])) ++i;
    word.comma = true;
    word.decimals = text.substr(begin, i - begin);
    if (word.decimals.empty()) return {};
  }
  if (i < text.size() && std::string_view("eEdD").find(text[i]) != std::string_view::npos) {
    ++i;
    if (i < text.size() && (text[i] == '-' || text[i] == '+')) ++i;
    const std::size_t begin = i;
    while (i < text.size() && is_digit(text[i])) ++i;
    if (i == begin) return {};
  }
  const bool digits =
      !word.decimals.empty() || (!word.whole.empty() && is_digit(word.whole.back()));
  if (i != text.size() || !digits) return {};
  return word;
}

std::vector<std::string_view> words_of(std::string_view text) {
  constexpr std::string_view between = "; \t";
  std::vector<std::string_view> words;
  for (std::size_t begin = text.find_first_not_of(between); begin != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(between, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(between, end);
  }
  return words;
}

/// Made of the characters of numbers, digits among them.
bool is_of_numbers(const std::string& text) {
  return !is_comment(text) && text.find_first_of("0123456789") != std::string::npos &&
         text.find_first_not_of("0123456789+-.,;eEdD \t") == std::string::npos;
}

/// Signs of decimal commas in the lines of numbers of a file.
struct Commas {
  std::size_t lines = 0, first = 0, with_comma = 0;
  bool possible = true;    ///< every word may have a decimal comma
  bool single = true;      ///< one word per line
  bool proof = false;      ///< decimals such as 05, a whole part such as -0
  bool increasing = true;  ///< the parts before the commas
  long long before = -1;

  void take(const std::string& text) {
    const auto words = words_of(text);
    single = single && words.size() == 1;
    for (const std::string_view one : words) {
      const auto word = read_word(one);
      if (!word) {
        possible = false;
        return;
      }
      if (word->comma) ++with_comma;
      const bool unusual_whole = word->whole.empty() || word->whole == "-0" ||
                                 word->whole == "+0" || !is_digit(word->whole.back());
      proof = proof ||
              (word->comma &&
               (unusual_whole || (word->decimals.size() > 1 && word->decimals.front() == '0')));
      const auto whole = parse_number(word->whole);
      increasing = increasing && whole && static_cast<long long>(*whole) > before;
      if (whole) before = static_cast<long long>(*whole);
    }
  }
};

void write_points(std::string& text) {
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    const bool before = is_digit(text[i - 1]) || text[i - 1] == '-' || text[i - 1] == '+' ||
                        text[i - 1] == ' ' || text[i - 1] == '\t' || text[i - 1] == ';';
    if (text[i] == ',' && before && is_digit(text[i + 1])) text[i] = '.';
  }
  if (text.size() > 1 && text[0] == ',' && is_digit(text[1])) text[0] = '.';
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
  refuse_if(text.find('\0') != std::string::npos,
            file + ": is not a text file" + kind_of_bytes(text) + "; export it as text");
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
  for (const auto word : split_words(line.text)) {
    const auto value = parse_number(word);
    if (!value) {
      auto values = parse_fixed_width(line.text);
      if (!values) return {};
      row.values = std::move(*values);
      break;
    }
    row.values.push_back(*value);
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

bool replace_decimal_commas(const std::string& file, int column, std::vector<TextLine>& lines) {
  Commas commas;
  for (std::size_t i = 0; i < lines.size() && commas.possible; ++i) {
    if (!is_of_numbers(lines[i].text)) continue;
    if (commas.lines++ == 0) commas.first = i;
    commas.take(lines[i].text);
  }
  if (!commas.possible || commas.lines == 0 || 2 * commas.with_comma < commas.lines) return false;
  if (commas.single && !commas.proof) {
    const bool named =
        commas.first > 0 && lines[commas.first - 1].text.find(',') != std::string::npos;
    if (named || column > 0 || commas.increasing) return false;
    throw UserError(at_line(file, lines[commas.first].number) + "'" + lines[commas.first].text +
                    "': a decimal comma, or two columns? Write the numbers with decimal points, "
                    "or give column: the number of one");
  }
  for (TextLine& line : lines) {
    if (line.text.find(',') != std::string::npos) write_points(line.text);
  }
  return true;
}

}  // namespace pounding
