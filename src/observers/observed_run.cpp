#include "observers/observed_run.h"

#include <filesystem>
#include <limits>

namespace pounding {

double whole_steps(const Model& model, double count) {
  constexpr double most = std::numeric_limits<int>::max();
  return std::clamp(count, 1.0, std::min(static_cast<double>(model.steps) + 1, most));
}

int record_stride(const Scene& scene, const Model& model) {
  return static_cast<int>(whole_steps(model, scene.output_interval / model.time_step));
}

std::int64_t gap_stride(const Scene& scene, const Model& model) {
  const int sample = record_stride(scene, model);
  const double records = whole_steps(model, scene.gap_interval / (model.time_step * sample));
  return sample * static_cast<std::int64_t>(records);
}

std::string ObservedRun::continued_path(const std::string& name) const {
  if (scene.restart.empty()) return "";
  return std::filesystem::path(scene.restart).replace_filename(name);
}

}  // namespace pounding
