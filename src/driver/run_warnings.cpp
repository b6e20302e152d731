#include <algorithm>
#include <cmath>

#include "driver/facts.h"
#include "driver/time_step.h"
#include "driver/warnings.h"
#include "scene/option_table.h"
#include "scene/option_values.h"

namespace pounding {
namespace {

constexpr double nearly = 1 + 1e-9;

bool stands_still(const Scene& scene) {
  const Vector3 zero{0, 0, 0};
  const bool shaken = std::ranges::any_of(
      scene.motion, [](const auto& component) { return component.has_value(); });
  return !shaken && scene.loads.empty() &&
         std::ranges::all_of(scene.structures, [&zero](const Structure& structure) {
           return !structure.starts_displaced() && !structure.starts_in_motion() &&
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
      scene.end_time > (last + component.time_step) * nearly) {
    warnings.push_back(
        sentence("option -end_time {} s: the record along {} ends at {} s, the ground stands still "
                 "afterwards",
                 {scene.end_time, direction_names[direction], last}));
  }
}

/// The largest acceleration of a component until a time [m/s2].
double peak_until(const Accelerogram& component, double end) {
  double peak = std::abs(component.at(end));  // linear between samples, 0 beyond the last
  for (std::size_t i = 0; i < component.acceleration.size(); ++i) {
    if (component.start + component.time_step * static_cast<double>(i) > end * nearly) break;
    peak = std::max(peak, std::abs(component.acceleration[i]));
  }
  return peak;
}

/// A motion whose peak comes after the end of the run.
void add_late_peak(const Scene& scene, const Accelerogram& component, int direction,
                   std::vector<std::string>& warnings) {
  constexpr double whole = 0.99;
  const double peak = component.peak();
  const double felt = peak_until(component, scene.end_time);
  if (felt >= whole * peak) return;
  warnings.push_back(sentence(
      "option -end_time {:.4g} s: the motion along {} has its peak of {:.4g} m/s2 later; the run "
      "feels {:.4g} m/s2 at most",
      {scene.end_time, direction_names[direction], peak, felt}));
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
  if (step > sample * nearly) {
    warnings.push_back(
        sentence("the time step {} s is longer than {}, {} s; give -time_step {} or less",
                 {step, of, sample, sample}));
  }
}

namespace {

/// Whether somebody asked for frequencies of spectra.
bool frequencies_are_asked(const Scene& scene) {
  const auto preset = parse_increasing(std::string(option_row("spectra_frequencies").preset.text));
  return scene.spectra.frequencies != preset;
}

/// Spectra beyond half the sampling frequency of the probes, or, where no impacts are looked for,
/// of the motion.
void add_high_spectra(const Scene& scene, const Model& model, std::vector<std::string>& warnings) {
  if (scene.probes.empty()) return;
  const double highest = scene.spectra.frequencies.back();
  const auto add = [&](const std::string& of, double interval, const std::string& what) {
    if (!(highest * 2 * interval > nearly)) return;
    warnings.push_back(sentence(
        "spectra go to {:.4g} Hz (-spectra_frequencies), {} every {:.4g} s tell nothing above "
        "{:.4g} Hz{}",
        {highest, of, interval, 0.5 / interval, what}));
  };
  if (scene.output_interval != parse_real(option_row("output_interval").preset.text)) {
    add("samples of the probes", scene.output_interval, "; give a shorter -output_interval");
  }
  if (!scene.contacts.empty() || !frequencies_are_asked(scene)) return;
  double coarsest = 0;
  for (int direction = 0; direction < 3; ++direction) {
    if (samples(model, direction).acceleration.empty()) continue;
    coarsest = std::max(coarsest, given_interval(model, direction));
  }
  add("samples of the motion", coarsest,
      ": beyond, only motion between the samples shows (-resampling)");
}

}  // namespace

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
      add_late_peak(scene, samples(model, direction), direction, warnings);
      add_long_step("a sample of the motion along " + std::string(direction_names[direction]),
                    given_interval(model, direction), model.time_step, warnings);
    }
  }
  for (const std::string& line : long_step_warnings(scene, model)) warnings.push_back(line);
  add_high_spectra(scene, model, warnings);
  // The interval that nobody asked for is as short as the step where that is longer.
  const auto preset = parse_real(option_row("output_interval").preset.text);
  if (!scene.probes.empty() && scene.output_interval != preset) {
    add_long_step("-output_interval", scene.output_interval, model.time_step, warnings);
  }
  return warnings;
}

}  // namespace pounding
