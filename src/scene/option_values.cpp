#include "scene/option_values.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace pounding {
namespace {

constexpr int max_range_count = 100000;

/// The whole text as a number of type Number, by std::from_chars.
template <typename Number>
std::optional<Number> parse_number(std::string_view text) {
  std::string digits = trimmed(text);
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.erase(0, 1);
  Number number{};
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, number);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return number;
}

std::optional<std::vector<double>> parse_range(const std::vector<std::string>& parts) {
  const std::string& count_and_law = parts[2];
  const bool logarithmic = count_and_law.ends_with("log");
  if (!logarithmic && !count_and_law.ends_with("lin")) return std::nullopt;
  const auto start = parse_real(parts[0]);
  const auto stop = parse_real(parts[1]);
  const auto count = parse_integer(count_and_law.substr(0, count_and_law.size() - 3));
  if (!start || !stop || !count || *count < 2 || *count > max_range_count || *start >= *stop ||
      (logarithmic && *start <= 0)) {
    return std::nullopt;
  }
  std::vector<double> values(*count);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double part = static_cast<double>(i) / (*count - 1);
    values[i] =
        logarithmic ? *start * std::pow(*stop / *start, part) : *start + part * (*stop - *start);
  }
  values.back() = *stop;
  return values;
}

}  // namespace

std::string trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(blanks) - first + 1));
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> pieces;
  while (true) {
    const std::size_t end = text.find(separator);
    pieces.push_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return pieces;
    text.remove_prefix(end + 1);
  }
}

bool has_needless_zero(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of("+- \t"), text.size()));
  return text.size() > 1 && text[0] == '0' && std::isdigit(static_cast<unsigned char>(text[1]));
}

std::string decimal_comma_hint(std::string_view text, bool one) {
  const std::vector<std::string> items = split(text, ',');
  for (std::size_t i = 0; i < items.size(); ++i) {
    const bool is_doubtful = has_needless_zero(items[i]) || (one && i == 1);
    if (!is_doubtful || !parse_number<double>(items[i])) continue;
    if (i == 0) return "'" + items[0] + "' begins with a needless zero";
    return "decimals have a point, is " + items[i - 1] + "." + items[i] + " meant?";
  }
  return "";
}

std::optional<double> parse_real(std::string_view text) {
  const auto number = parse_number<double>(text);
  return number && std::isfinite(*number) && !has_needless_zero(text) ? number : std::nullopt;
}

std::optional<int> parse_integer(std::string_view text) {
  return parse_number<int>(text);
}

std::optional<bool> parse_boolean(std::string_view text) {
  std::string word = trimmed(text);
  std::ranges::transform(word, word.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (word.empty() || word == "true" || word == "yes" || word == "on" || word == "1") return true;
  if (word == "false" || word == "no" || word == "off" || word == "0") return false;
  return std::nullopt;
}

std::optional<std::vector<double>> parse_reals(std::string_view text) {
  std::vector<double> values;
  for (const std::string& piece : split(text, ',')) {
    const auto value = parse_real(piece);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

std::optional<Vector3> parse_point(std::string_view text) {
  const auto numbers = parse_reals(text);
  if (!numbers || numbers->size() != 3) return std::nullopt;
  return Vector3{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

std::optional<std::vector<double>> parse_increasing(std::string_view text) {
  const std::vector<std::string> parts = split(text, ':');
  auto values = parts.size() == 3   ? parse_range(parts)
                : parts.size() == 1 ? parse_reals(text)
                                    : std::nullopt;
  if (!values || std::ranges::adjacent_find(*values, std::greater_equal<>{}) != values->end()) {
    return std::nullopt;
  }
  return values;
}

bool are_of_oscillators(const std::vector<double>& frequencies) {
  return frequencies.front() >= 1e-6 && frequencies.back() <= 1e6;
}

std::string upper_case(std::string_view text) {
  std::string upper(text);
  for (char& letter : upper) {
    if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
  }
  return upper;
}

std::string shown_value(std::string_view text) {
  constexpr std::size_t longest = 80;
  std::string line = trimmed(text);
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < ' ' || c == 0x7f; }, ' ');
  if (line.empty()) return "(no value)";
  return line.size() <= longest ? line : line.substr(0, longest) + "...";
}

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> two_back(b.size() + 1);
  std::vector<int> previous(b.size() + 1);
  std::vector<int> current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) current[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    two_back.swap(previous);
    previous.swap(current);
    current[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replaced = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        current[j] = std::min(current[j], two_back[j - 2] + 1);
      }
    }
  }
  return current[b.size()];
}

std::optional<std::string> nearest_name(std::string_view name,
                                        const std::vector<std::string>& candidates) {
  std::optional<std::string> nearest;
  int least = 1 + static_cast<int>(name.size()) / 5;
  for (const std::string& candidate : candidates) {
    const int distance = edit_distance(name, candidate);
    if (distance < least || (distance == least && !nearest)) {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& candidates) {
  const auto nearest = nearest_name(name, candidates);
  return nearest ? "; did you mean " + *nearest + "?" : "";
}

}  // namespace pounding
