#include "scene/resolved_options.h"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace pounding {
namespace {

/// A double-quoted YAML scalar.
std::string quoted(const std::string& value) {
  std::string text = "\"";
  for (const char c : value) {
    if (c == '\n') {
      text += "\\n";
    } else if (c == '\t') {
      text += "\\t";
    } else {
      text += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    }
  }
  return text + "\"";
}

std::string yaml_line(const std::string& name, const std::string& value) {
  const bool plain =
      std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
  return (plain ? name : quoted(name)) + ": " + quoted(value) + "\n";
}

}  // namespace

std::string resolved_yaml(const OptionReader& options) {
  std::string text =
      "# All options in force, defaults included; running this file repeats the run.\n";
  for (const auto& [name, value] : options.in_force()) text += yaml_line(name, value);
  for (const auto& [name, value] : options.database()) {
    if (is_petsc_option(name)) text += yaml_line(name, value);
  }
  return text;
}

std::vector<std::pair<std::string, std::string>> resolved_values(const std::string& yaml) {
  std::vector<std::pair<std::string, std::string>> values;
  std::istringstream lines(yaml);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(": ");
    if (line.empty() || line[0] == '#' || colon == std::string::npos) continue;
    std::string value = line.substr(colon + 2);
    if (value.size() >= 2 && value.front() == '"' && value.back() == '"') {
      value = value.substr(1, value.size() - 2);
      // Inside quotes a backslash precedes a quote or another backslash.
      for (std::size_t at = value.find('\\'); at != std::string::npos;
           at = value.find('\\', at + 1)) {
        value.erase(at, 1);
      }
    }
    std::string name = line.substr(0, colon);
    if (name.size() >= 2 && name.front() == '"') name = name.substr(1, name.size() - 2);
    values.emplace_back(name, value);
  }
  return values;
}

}  // namespace pounding
