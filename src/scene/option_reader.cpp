#include "scene/option_reader.h"

#include <cmath>

#include "common/error.h"
#include "scene/option_values.h"

namespace pounding {
namespace {

/// Fault of a number, or null. Beyond these sizes lies no quantity of a building in any unit, and
/// products of a few of them leave the range of a double.
const char* fault_of(double number, const AdmittedRange& range) {
  constexpr double largest = 1e30;
  if (!range.contains(number)) return "out of range";
  const double size = std::abs(number);
  const bool holdable = size == 0 || (size >= 1 / largest && size <= largest);
  return holdable ? nullptr : "neither 0 nor between 1e-30 and 1e30 in size";
}

/// Whether a value equals the default, in other digits perhaps.
bool is_preset(const OptionRow& row, const std::string& value) {
  if (!row.preset.has_value) return false;
  const auto numbers = parse_reals(value);
  const auto preset = parse_reals(std::string(row.preset.text));
  if (numbers && preset) return *numbers == *preset;
  const auto flag = parse_boolean(value);
  if (row.kind == OptionKind::boolean && flag) {
    return flag == parse_boolean(std::string(row.preset.text));
  }
  return value == row.preset.text;
}

/// Words in which placeholders of a pattern are replaced by their names.
std::string filled(std::string text, std::string_view pattern, const OptionReader::Names& names) {
  for (const std::string& name : names) {
    pattern.remove_prefix(pattern.find('<'));
    const std::string_view holder = pattern.substr(0, pattern.find('>') + 1);
    for (std::size_t at = 0; (at = text.find(holder, at)) != std::string::npos; at += name.size()) {
      text.replace(at, holder.size(), name);
    }
    pattern.remove_prefix(holder.size());
  }
  return text;
}

constexpr std::string_view damping_factor = "<structure>_damping_factor";

}  // namespace

bool OptionReader::given(std::string_view pattern, const Names& names) const {
  return database_.contains(option_name(pattern, names));
}

bool OptionReader::changed(std::string_view pattern, const Names& names) const {
  return given(pattern, names) && !is_preset(option_row(pattern), value(pattern, names));
}

std::string OptionReader::value(std::string_view pattern, const Names& names) const {
  const OptionRow& row = option_row(pattern);
  const auto entry = database_.find(option_name(pattern, names));
  if (entry != database_.end()) return trimmed(entry->second);
  if (!row.preset.has_value) {
    throw UserError("missing option -" + option_name(pattern, names) + " (" +
                    std::string(row.help) + "): expected " + expected_text(row));
  }
  return std::string(row.preset.text);
}

void OptionReader::keep(std::string_view pattern, const Names& names) {
  const OptionRow& row = option_row(pattern);
  auto owner = std::ranges::find_if(
      in_force_, [&](const Owner& one) { return one.block == row.block && one.names == names; });
  if (owner == in_force_.end()) {
    owner = in_force_.insert(owner, {row.block, names, {}});
  }
  owner->values.emplace(&row, value(pattern, names));
}

OptionValues OptionReader::in_force() const {
  std::vector<std::pair<std::string, std::string>> options;
  for (const Owner& owner : in_force_) {
    for (const auto& [row, value] : owner.values) {
      options.emplace_back(option_name(row->pattern, owner.names), value);
    }
  }
  return options;
}

std::vector<Vector3> OptionReader::points(std::string_view pattern, const Names& names) {
  std::vector<Vector3> points;
  for (const std::string& item : split(text(pattern, names), ';')) {
    const auto numbers = parse_reals(item);
    if (!numbers || numbers->size() != 3) refuse(pattern, names, "'" + item + "' is not a point");
    for (const double number : *numbers) {
      if (const char* fault = fault_of(number, AdmittedRange{})) refuse(pattern, names, fault);
    }
    points.push_back({(*numbers)[0], (*numbers)[1], (*numbers)[2]});
  }
  return points;
}

void OptionReader::refuse(std::string_view pattern, const Names& names,
                          const std::string& why) const {
  const std::string shown = shown_value(value(pattern, names));
  const std::string hint = decimal_comma_hint(shown, option_row(pattern).kind == OptionKind::real);
  throw UserError("option -" + option_name(pattern, names) + " " + shown +
                  (given(pattern, names) ? "" : " (default)") + ": " +
                  (why.empty() ? "" : filled(why, pattern, names) + "; ") +
                  (hint.empty() ? "" : hint + "; ") + "expected " +
                  expected_text(option_row(pattern)));
}

void OptionReader::forbid(std::string_view pattern, const Names& names,
                          const std::string& why) const {
  if (given(pattern, names)) {
    throw UserError("option -" + option_name(pattern, names) + " " +
                    shown_value(value(pattern, names)) + ": " + filled(why, pattern, names));
  }
}

std::string OptionReader::text(std::string_view pattern, const Names& names) {
  const Preset& preset = option_row(pattern).preset;
  std::string result = value(pattern, names);
  if (result.empty() && !(preset.has_value && preset.text.empty())) refuse(pattern, names);
  keep(pattern, names);
  return result;
}

std::string OptionReader::path(std::string_view pattern, const Names& names) {
  std::string result = text(pattern, names);
  return result == "none" ? "" : result;
}

void OptionReader::take_text(std::string_view pattern, const Names& names, std::string& member) {
  const OptionRow& row = option_row(pattern);
  member = row.kind == OptionKind::choice ? choice(pattern, names) : text(pattern, names);
  if (row.preset.text == "none" && member == "none") member.clear();
}

std::size_t OptionReader::choice_number(std::string_view pattern, const Names& names) {
  const std::vector<std::string> words = split(option_row(pattern).form, '|');
  const std::string word = value(pattern, names);
  const auto found = std::ranges::find(words, word);
  if (found == words.end()) {
    const auto near = nearest_name(word, words);
    refuse(pattern, names, near ? "did you mean " + *near + "?" : "not supported");
  }
  keep(pattern, names);
  return static_cast<std::size_t>(found - words.begin());
}

std::string OptionReader::choice(std::string_view pattern, const Names& names) {
  return split(option_row(pattern).form, '|')[choice_number(pattern, names)];
}

double OptionReader::real(std::string_view pattern, const Names& names) {
  const auto number = parse_real(value(pattern, names));
  if (!number) refuse(pattern, names, "not a finite number");
  if (const char* fault = fault_of(*number, option_row(pattern).range)) {
    refuse(pattern, names, fault);
  }
  keep(pattern, names);
  return *number;
}

int OptionReader::integer(std::string_view pattern, const Names& names) {
  const auto number = parse_integer(value(pattern, names));
  if (!number || !option_row(pattern).range.contains(*number)) {
    refuse(pattern, names, number ? "out of range" : "not an integer");
  }
  keep(pattern, names);
  return *number;
}

bool OptionReader::boolean(std::string_view pattern, const Names& names) {
  const auto flag = parse_boolean(value(pattern, names));
  if (!flag) refuse(pattern, names);
  keep(pattern, names);
  return *flag;
}

std::vector<std::string> OptionReader::list(std::string_view pattern, const Names& names) {
  const bool required = option_row(pattern).preset.required;
  const std::string whole = value(pattern, names);
  std::vector<std::string> items = split(whole, ',');
  if (whole == "none" && !required) items.clear();
  for (auto item = items.begin(); item != items.end(); ++item) {
    if (item->empty()) refuse(pattern, names, "empty name");
    if (*item == "none") refuse(pattern, names, "none is not a name");
    if (std::find(items.begin(), item, *item) != item) {
      refuse(pattern, names, *item + " appears twice");
    }
  }
  keep(pattern, names);
  return items;
}

std::vector<double> OptionReader::reals(std::string_view pattern, const Names& names,
                                        std::size_t count) {
  const auto numbers = parse_reals(value(pattern, names));
  if (!numbers) refuse(pattern, names, "not finite numbers between commas");
  if (count != 0 && numbers->size() != count) refuse(pattern, names, "wrong count of numbers");
  const AdmittedRange& range = option_row(pattern).range;
  for (const double number : *numbers) {
    if (const char* fault = fault_of(number, range)) refuse(pattern, names, fault);
  }
  keep(pattern, names);
  return *numbers;
}

std::string goes_with(std::string_view pattern, const std::string& value) {
  return "goes with -" + std::string(pattern) + (value.empty() ? "" : " " + value) +
         ", which is not given";
}

double read_damping_factor(OptionReader& options, const std::string& structure) {
  return options.real(damping_factor, {structure});
}

}  // namespace pounding
