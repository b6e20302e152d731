#include "motion/ground_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "common/array_reductions.h"
#include "common/error.h"
#include "motion/fourier.h"
#include "motion/incoherent_wave.h"
#include "motion/records/record_text.h"
#include "motion/synthetic.h"

namespace pounding {

namespace {

constexpr double doubtful_pga = 3 * standard_gravity;  // m/s2
constexpr double small_pga = 0.5;                      // m/s2: might be a number in g

/// Part of the largest velocity of a wave that may be left at its end.
constexpr double resting = 0.05;

void check_scaling(const std::string& name, const MotionComponent& component) {
  const double pga = component.pga, scale = component.scale;
  refuse_if(!std::isfinite(pga) || pga < 0,
            name + ": pga " + text_of(pga) + " must be positive [m/s2]");
  refuse_if(!std::isfinite(scale), name + ": scale " + text_of(scale) + " must be a finite number");
  refuse_if(pga > 0 && scale != 1, name + ": pga " + text_of(pga) + " and scale " + text_of(scale) +
                                       " exclude one another; give one of them");
  refuse_if(pga == 0 && std::holds_alternative<SyntheticMotion>(component.source),
            name + ": a synthetic motion needs a pga [m/s2]");
}

double scaling_factor(const std::string& name, const MotionComponent& component,
                      const MotionDescription& description) {
  if (component.pga == 0) return component.scale;
  const double factor = component.pga / description.file_peak;
  refuse_if(!std::isfinite(factor),
            name + ": " + description.source + " is zero throughout and cannot be scaled to pga " +
                text_of(component.pga) + "; leave pga out or give another record");
  return factor;
}

void require_possible_peak(const std::string& name, const std::string& what, double peak) {
  refuse_if(!(peak <= impossible_peak),
            name + ": " + what + " " + text_of(peak) + " m/s2 (" +
                text_of(peak / standard_gravity) + " g) is above " + text_of(impossible_peak) +
                " m/s2 (10000 g), which nothing bears; correct unit, scale or pga");
}

/// Motion of a ground that starts at rest: at the end, and the largest displacement at the samples.
struct IntegratedMotion {
  double velocity = 0, displacement = 0, largest_displacement = 0;  // m/s, m
};

/// Exact for straight lines between samples.
IntegratedMotion integrate(const Accelerogram& motion) {
  const double h = motion.time_step;
  IntegratedMotion found;
  for (std::size_t i = 1; i < motion.acceleration.size(); ++i) {
    const double before = motion.acceleration[i - 1], after = motion.acceleration[i];
    found.displacement += h * (found.velocity + h * (2 * before + after) / 6);
    found.velocity += h * (before + after) / 2;
    found.largest_displacement = std::max(found.largest_displacement, std::abs(found.displacement));
  }
  return found;
}

/// A ground that jumps by a displacement within a few samples has any acceleration.
void require_possible_record(const std::string& name, const std::string& what, double peak,
                             const Accelerogram& motion) {
  if (!(peak <= impossible_peak) && integrate(motion).largest_displacement <= possible_jump) return;
  require_possible_peak(name, what, peak);
}

MotionDescription describe_synthetic(const SyntheticMotion& motion) {
  return {.source = motion.target,
          .layout = "synthetic, seed " + std::to_string(motion.seed),
          .treatment = "made to end without velocity and displacement"};
}

MotionDescription describe_record(const std::string& file, const Accelerogram& record) {
  return {.component = record.component,
          .source = file,
          .layout = record.layout,
          .unit = record.unit,
          .file_start = record.start,
          .has_times = record.has_times,
          .file_peak = record.peak(),
          .treatment = "baseline as recorded, no correction"};
}

std::string scaling_text(const MotionComponent& component) {
  if (component.pga > 0) return "to pga " + text_of(component.pga) + " m/s2";
  return component.scale == 1 ? "none" : "by " + text_of(component.scale);
}

/// Velocity at time t of an acceleration that is linear between samples, of those at its samples.
double velocity_at(const Accelerogram& motion, const std::vector<double>& v, double t) {
  const std::vector<double>& a = motion.acceleration;
  const double x = (t - motion.start) / motion.time_step;
  if (!(x > 0) || v.empty()) return 0;
  if (x >= static_cast<double>(v.size() - 1)) return v.back();
  const auto i = static_cast<std::size_t>(x);
  const double part = x - static_cast<double>(i);
  return v[i] + motion.time_step * part * (a[i] + part * (a[i + 1] - a[i]) / 2);
}

// Peaks of one direction that hint at another unit.
std::vector<std::string> peak_doubts(const std::string& name, const MotionComponent& component,
                                     const MotionDescription& description) {
  if (component.pga > 0 && component.pga <= small_pga) {
    return {name + ": pga " + text_of(component.pga) + " m/s2 is " +
            text_of(component.pga / standard_gravity) + " g; if g was meant, give " +
            text_of(component.pga * standard_gravity)};
  }
  if (description.pga > doubtful_pga) {
    return {name + ": the peak of " + description.source + " is " + text_of(description.pga) +
            " m/s2 (" + text_of(description.pga / standard_gravity) +
            " g), above 3 g; are unit, scale and pga right?"};
  }
  return {};
}

}  // namespace

std::vector<std::string> synthetic_doubts(const std::string& name,
                                          const MotionComponent& component) {
  const auto& synthetic = std::get<SyntheticMotion>(component.source);
  check_scaling(name, component);
  require_possible_peak(name, "pga", component.pga);
  check_synthetic(read_target_spectrum(synthetic.target), synthetic, component.pga);
  MotionDescription description = describe_synthetic(synthetic);
  description.pga = component.pga;
  return peak_doubts(name, component, description);
}

void GroundMotion::add(std::size_t direction, const MotionComponent& component) {
  const std::string name = name_ + " " + direction_names[direction];
  check_scaling(name, component);
  Accelerogram& accelerogram = components_[direction];
  MotionDescription description;
  if (const auto* synthetic = std::get_if<SyntheticMotion>(&component.source)) {
    require_possible_peak(name, "pga", component.pga);
    description = describe_synthetic(*synthetic);
    accelerogram =
        generate_accelerogram(read_target_spectrum(synthetic->target), *synthetic, component.pga);
  } else {
    const auto& record = std::get<RecordedMotion>(component.source);
    accelerogram = read_accelerogram(record);
    description = describe_record(record.file, accelerogram);
    file_start_[direction] = accelerogram.start;
    require_possible_record(name, record.file + ": peak", description.file_peak, accelerogram);
    const double factor = scaling_factor(name, component, description);
    description.factor = factor;
    for (double& a : accelerogram.acceleration) a *= factor;
    require_possible_record(name, "scaled peak", accelerogram.peak(), accelerogram);
  }
  description.direction = direction_names[direction];
  description.points = accelerogram.acceleration.size();
  description.time_step = accelerogram.time_step;
  description.duration = accelerogram.duration();
  description.scaling = scaling_text(component);
  description.pga = accelerogram.peak();
  const IntegratedMotion ground = integrate(accelerogram);
  description.end_velocity = ground.velocity;
  description.end_displacement = ground.displacement;
  for (const std::string& doubt : accelerogram.doubts) doubts_.push_back(name + ": " + doubt);
  std::ranges::copy(peak_doubts(name, component, description), std::back_inserter(doubts_));
  descriptions_.push_back(std::move(description));
}

GroundMotion::GroundMotion(const std::array<std::optional<MotionComponent>, 3>& components,
                           Resampling resampling, std::string name)
    : name_(std::move(name)) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!components[i]) continue;
    add(i, *components[i]);
    std::string& treatment = descriptions_.back().treatment;
    treatment += ", straight lines between samples";
    if (resampling == Resampling::band_limited) {
      components_[i] = resample_band_limited(components_[i], resampled_step);
      treatment += " after band-limited resampling to " + text_of(components_[i].time_step) + " s";
    }
  }
  count_times_from(earliest().value_or(0));
  add_start_doubts();
  double largest = 0;
  bool as_given = !descriptions_.empty();  // peaks of accelerations that no option names
  for (const auto& component : components) {
    const auto* record = component ? std::get_if<RecordedMotion>(&component->source) : nullptr;
    as_given = as_given && !(record != nullptr && record->is_of_displacement());
  }
  for (const MotionDescription& description : descriptions_) {
    largest = std::max(largest, description.pga);
    as_given = as_given && description.file_peak > 0 && !description.scaling.starts_with("to pga");
  }
  if (as_given && largest <= small_pga) {
    doubts_.push_back(name_ + ": the largest peak is " + text_of(largest) +
                      " m/s2, not above 0.5 m/s2; are the files' numbers in g?");
  }
}

std::optional<double> GroundMotion::earliest() const {
  std::optional<double> first;
  for (std::size_t d = 0; d < 3; ++d) {
    if (!active(static_cast<int>(d))) continue;
    first = std::min(first.value_or(file_start_[d]), file_start_[d]);
  }
  return first;
}

void GroundMotion::count_times_from(double origin) {
  origin_ = origin;
  for (std::size_t d = 0; d < 3; ++d) {
    if (active(static_cast<int>(d))) components_[d].start = file_start_[d] - origin;
  }
  for (MotionDescription& description : descriptions_) {
    const std::size_t d = static_cast<std::size_t>(description.direction[0] - 'x');
    description.start = components_[d].start;
  }
}

GroundMotion GroundMotion::part(Part part, double from, double to) const {
  GroundMotion result(*this);
  for (Accelerogram& component : result.components_) {
    for (std::size_t i = 0; i < component.acceleration.size(); ++i) {
      const double t = component.start + static_cast<double>(i) * component.time_step;
      const double share = std::clamp((t - from) / (to - from), 0.0, 1.0);
      const double weight = (1 - std::cos(std::numbers::pi * share)) / 2;
      component.acceleration[i] *= part == Part::sets_in ? weight : 1 - weight;
    }
  }
  return result;
}

GroundMotion GroundMotion::times(double factor) const {
  GroundMotion result(*this);
  for (Accelerogram& component : result.components_) {
    for (double& value : component.acceleration) value *= factor;
  }
  return result;
}

GroundMotion GroundMotion::counted_from(double origin) const {
  GroundMotion result(*this);
  for (Accelerogram& component : result.components_) component.start -= origin;
  return result;
}

/// A record that sets in late by its own times beside one that has none.
void GroundMotion::add_start_doubts() {
  for (const MotionDescription& late : descriptions_) {
    for (const MotionDescription& other : descriptions_) {
      if (late.start == 0 || other.has_times || late.direction == other.direction) continue;
      doubts_.push_back(name_ + " " + late.direction + ": the times of " + late.source +
                        " begin at " + text_of(late.file_start) + " s, so it sets in at " +
                        text_of(late.start) + " s; " + other.source +
                        " has no times and sets in at " + text_of(other.start) +
                        " s: do they belong together like that?");
    }
  }
}

void GroundMotion::enter_from_below() {
  from_below_ = true;
  for (std::size_t d = 0; d < 3; ++d) {
    std::swap(incident_[d], components_[d]);
    integrate_incident();
    const std::vector<double>& at = incident_velocity_.back();
    const double velocity = at.empty() ? 0 : at.back();
    const double largest = largest_magnitude(at);
    if (std::abs(velocity) > resting * largest) {
      doubts_.push_back(std::string("motion ") + direction_names[d] +
                        ": the wave from below ends at " + text_of(velocity) +
                        " m/s, its largest is " + text_of(largest) +
                        " m/s: the site drifts off; give a record that ends at rest");
    }
  }
}

/// Velocities of the next of the accelerations from below.
void GroundMotion::integrate_incident() {
  const Accelerogram& incident = incident_[incident_velocity_.size()];
  const std::vector<double>& a = incident.acceleration;
  std::vector<double>& velocity = incident_velocity_.emplace_back(a.size(), 0.0);
  for (std::size_t i = 1; i < a.size(); ++i) {
    velocity[i] = velocity[i - 1] + incident.time_step * (a[i - 1] + a[i]) / 2;
  }
}

void GroundMotion::add_incoherent(const std::string& file, Resampling resampling) {
  for (Accelerogram& history : read_incoherent_wave(file, incident_, resampling)) {
    incident_.push_back(std::move(history));
    integrate_incident();
  }
}

void GroundMotion::evaluate_incident(double t, std::span<double> velocities) const noexcept {
  for (std::size_t k = 0; k < velocities.size(); ++k) {
    velocities[k] = from_below_ ? velocity_at(incident_[k], incident_velocity_[k], t) : 0;
  }
}

Vector3 GroundMotion::peaks() const {
  return {components_[0].peak(), components_[1].peak(), components_[2].peak()};
}

double GroundMotion::peak_acceleration() const {
  const Vector3 peak = peaks();
  return std::hypot(peak[0], peak[1], peak[2]);
}

}  // namespace pounding
