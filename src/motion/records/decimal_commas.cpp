#include "motion/records/decimal_commas.h"

#include <cctype>
#include <string_view>

#include "common/error.h"

namespace pounding {

namespace {

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
