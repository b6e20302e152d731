#include "common/facts.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>

namespace pounding {
namespace {

/// Unit of a report, in which an SI value is `factor` / `divisor` times as much.
struct ReportUnit {
  std::string_view name{};
  double factor = 1;
  double divisor = 1;
};

constexpr std::array report_units{ReportUnit{},
                                  ReportUnit{"mm", 1000},
                                  ReportUnit{"ms", 1000},
                                  ReportUnit{"%", 100},
                                  ReportUnit{"kN", 1, 1000},
                                  ReportUnit{"kPa", 1, 1000},
                                  ReportUnit{"MB", 1, 1e6}};

template <typename Value>
std::string printed(const std::string& conversion, Value value) {
  const std::string format = "%" + conversion;
  std::string text(static_cast<std::size_t>(std::snprintf(nullptr, 0, format.c_str(), value)), ' ');
  std::snprintf(text.data(), text.size() + 1, format.c_str(), value);
  return text;
}

/// A value by a conversion, by the plain one where that is none for it.
std::string printed(const Json& value, const std::string& conversion, const ReportUnit& unit) {
  if (value.is_array()) {
    std::string list;
    for (const Json& each : value) {
      if (!list.empty()) list += value.size() == 2 ? " to " : ", ";
      list += printed(each, conversion, unit);
    }
    return value.size() == 2 ? list : "(" + list + ")";
  }
  const char kind = conversion.empty() ? ' ' : conversion.back();
  if (value.is_string()) {
    return printed(kind == 's' ? conversion : "s", value.get<std::string>().c_str());
  }
  if (value.is_number_integer() && (kind == ' ' || kind == 'd')) {
    return printed(conversion.substr(0, conversion.find('d')) + "lld", value.get<long long>());
  }
  const bool suits = kind == 'e' || kind == 'f' || kind == 'g';
  return printed(suits ? conversion : "g", value.get<double>() * unit.factor / unit.divisor);
}

/// Takes the part before the mark off a text, and the mark.
std::string_view take_until(char mark, std::string_view& text) {
  const std::size_t end = std::min(text.find(mark), text.size());
  const std::string_view head = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return head;
}

/// The value at a path of keys and places in lists; null if there is none.
Json value_at(const Json& object, std::string_view path) {
  const Json* found = &object;
  while (!path.empty()) {
    const std::string key(take_until('/', path));
    const Json::json_pointer step("/" + key);
    if (!found->contains(step)) return nullptr;
    found = &found->at(step);
  }
  return *found;
}

/// Text of a slot whose name has this value.
std::string filled(const Json& value, std::string_view form) {
  const std::string conversion(take_until(' ', form));
  const bool silent = form.starts_with('[');
  const std::string_view name = silent ? form.substr(1, form.size() - 2) : form;
  const auto unit = std::ranges::find(report_units, name, &ReportUnit::name);
  if (unit == report_units.end()) throw std::logic_error("unit of a report " + std::string(name));
  const std::string text = printed(value, conversion, *unit);
  return silent || name.empty() ? text : text + " " + std::string(name);
}

}  // namespace

std::string told(std::string_view pattern, const Json& object, std::initializer_list<Json> values) {
  std::string text;
  std::size_t part = 0;  // where the text of the part in brackets begins
  bool has_slots = false;
  bool is_left_out = false;
  auto next = values.begin();
  for (std::size_t at = 0; at < pattern.size(); ++at) {
    if (pattern[at] == '{') {
      std::string_view slot = pattern.substr(at + 1, pattern.find('}', at) - at - 1);
      at += slot.size() + 1;
      const std::string_view name = take_until(':', slot);
      const Json value = !name.empty()          ? value_at(object, name)
                         : next != values.end() ? *next++
                                                : Json();
      if (!value.is_null()) text += filled(value, slot);
      if (!has_slots) is_left_out = is_nothing(value);
      has_slots = true;
    } else if (pattern[at] == ']' && has_slots && part < text.size() && text[part] == '[') {
      text.erase(part, is_left_out ? std::string::npos : 1);
    } else {
      if (pattern[at] == '[') {
        part = text.size();
        has_slots = is_left_out = false;
      }
      text += pattern[at];
    }
  }
  return text;
}

bool is_nothing(const Json& value) {
  if (value.is_structured()) return std::ranges::all_of(value, is_nothing);
  return value.is_null() || value == "" || value == 0 || value == false;
}

Json without_nothing(const Json& object) {
  Json kept = Json::object();
  for (const auto& [key, value] : object.items()) {
    if (!is_nothing(value)) kept[key] = value;
  }
  return kept;
}

void print(const std::string& text) {
  std::string shown = text;
  std::ranges::replace_if(
      shown, [](unsigned char c) { return (c < ' ' && c != '\n') || c == 0x7f; }, ' ');
  std::fputs(shown.c_str(), stdout);
}

}  // namespace pounding
