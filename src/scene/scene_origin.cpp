#include "scene/scene_origin.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "scene/option_values.h"

namespace pounding {
namespace {

/// Options of the whole run that leave the physics as it is.
constexpr auto of_the_run = std::to_array<std::string_view>(
    {"output",           "restart",           "dry_run",         "write_modes",
     "write_model",      "progress_interval", "mesh_time_limit", "checkpoint_interval",
     "checkpoint_steps", "export_matrices",   "csv_digits",      "partition",
     "mesh_pieces",      "write_mesh_pieces", "fields_interval", "fields_start",
     "fields_end",       "fields_format",     "predict_ranks",   "latency",
     "bandwidth",        "vector_unit"});

bool is_silent(const std::string& name) {
  return std::ranges::find(of_the_run, name) != of_the_run.end() ||
         name.ends_with("_modal_basis") || is_petsc_option(name);
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
