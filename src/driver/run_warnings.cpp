#include "driver/run_warnings.h"

#include <algorithm>
#include <sstream>

#include "scene/option_table.h"
#include "scene/option_values.h"

namespace pounding {
namespace {

constexpr double round_off = 1 + 1e-9;

bool stands_still(const Scene& scene) {
  const Vector3 zero{0, 0, 0};
  const bool shaken = std::ranges::any_of(
      scene.motion, [](const auto& component) { return component.has_value(); });
  return !shaken && std::ranges::all_of(scene.structures, [&zero](const Structure& structure) {
    return structure.initial_displacement == zero && structure.initial_velocity == zero &&
           structure.gravity == zero;
  });
}

const Accelerogram& samples(const Model& model, int direction) {
  return model.motion->from_below() ? model.motion->incident(direction)
                                    : model.motion->component(direction);
}

/// A record of its own that ends before the run. Synthetic motions are made as long as asked.
void add_short_record(const Scene& scene, const Model& model, int direction,
                      std::vector<std::string>& warnings) {
  const Accelerogram& component = samples(model, direction);
  const auto& asked = scene.motion[direction];
  const double last = component.end();
  if (std::holds_alternative<RecordedMotion>(asked->source) &&
      scene.end_time > (last + component.time_step) * round_off) {
    std::ostringstream text;
    text << "option -end_time " << scene.end_time << " s: the record along "
         << direction_names[direction] << " ends at " << last
         << " s, the ground stands still afterwards";
    warnings.push_back(text.str());
  }
}

/// Between the samples of a direction as they are given: resampling adds nothing to step over.
double given_interval(const Model& model, int direction) {
  for (const MotionDescription& description : model.motion->descriptions()) {
    if (description.direction == direction_names[direction]) return description.time_step;
  }
  return samples(model, direction).time_step;
}

}  // namespace

void add_long_step(const std::string& of, double sample, double step,
                   std::vector<std::string>& warnings) {
  if (step > sample * round_off) {
    std::ostringstream text;
    text << "the time step " << step << " s is longer than " << of << ", " << sample
         << " s; give -time_step " << sample << " or less";
    warnings.push_back(text.str());
  }
}

std::vector<std::string> run_warnings(const Scene& scene, const Model& model) {
  std::vector<std::string> warnings;
  if (stands_still(scene) && model.support_columns().empty() && !scene.dry_run &&
      scene.export_matrices.empty()) {
    warnings.emplace_back(
        "nothing makes the scene move: no -motion_x_record or -motion_x_target (nor y, z), no "
        "initial displacement or velocity, no gravity");
  }
  for (int direction = 0; direction < 3; ++direction) {
    if (!samples(model, direction).acceleration.empty()) {
      add_short_record(scene, model, direction, warnings);
      add_long_step("a sample of the motion along " + std::string(direction_names[direction]),
                    given_interval(model, direction), model.time_step, warnings);
    }
  }
  // The interval that nobody asked for is as short as the step where that is longer.
  const auto preset = parse_real(option_row("output_interval").preset.text);
  if (!scene.probes.empty() && scene.output_interval != preset) {
    add_long_step("-output_interval", scene.output_interval, model.time_step, warnings);
  }
  return warnings;
}

}  // namespace pounding
