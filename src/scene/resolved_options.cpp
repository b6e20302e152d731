#include "scene/resolved_options.h"

#include <algorithm>
#include <cctype>

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

/// Files are read already, and the others do not belong to the run.
bool belongs_to_the_run(const std::string& name) {
  return is_petsc_option(name) && !name.starts_with("options_") && name != "include" &&
         name != "help" && name != "version";
}

}  // namespace

std::string resolved_yaml(const OptionReader& options) {
  std::string text =
      "# All options in force, defaults included; running this file repeats the run.\n";
  for (const auto& [name, value] : options.in_force()) {
    text += yaml_line(name, value);
  }
  for (const auto& [name, value] : options.database()) {
    if (belongs_to_the_run(name)) {
      text += yaml_line(name, value);
    }
  }
  return text;
}

}  // namespace pounding
