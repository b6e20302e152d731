#include "scene/scene_origin.h"

#include "scene/option_table.h"
#include "scene/option_values.h"

namespace pounding {
namespace {

bool is_silent(const std::string& name) {
  return may_differ(name, Comparison::scene) || name.ends_with("_modal_basis");
}

}  // namespace

SceneOrigin origin_of(const CommandLine& line, const std::vector<std::string>& files) {
  SceneOrigin origin{files, {}};
  for (const auto& [name, value] : line.options) {
    if (!files.empty() && name != "include" && !is_silent(name)) {
      origin.overrides.emplace_back(name, trimmed(value));
    }
  }
  return origin;
}

std::string overrides_text(const SceneOrigin& origin) {
  std::string text;
  for (const auto& [name, value] : origin.overrides) {
    if (name == "title") continue;
    text += (text.empty() ? "with " : ", ") + name;
    if (!value.empty()) text += " " + value;
  }
  return text;
}

}  // namespace pounding
