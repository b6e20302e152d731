#include "motion/support_motion.h"

#include <algorithm>
#include <cmath>

#include "common/component_names.h"
#include "common/error.h"
#include "motion/kinematic_interaction.h"
#include "motion/record_text.h"
#include "motion/resampling.h"
#include "scene/support_reader.h"

namespace pounding {
namespace {

constexpr double resampled_step = 5e-4;  // s

/// Beyond what a foundation turns by [rad/s2]: its edge at 1 m would have ten thousand g.
constexpr double impossible_rotation = impossible_peak;

/// Parts of the largest velocity, and of the largest displacement, that may be left at the end.
constexpr double resting = 0.05;
constexpr double returned = 0.5;

/// Steps of the rule that finds how far a support moves.
constexpr double coarse_step = 1e-3;  // s

/// a(t), linear between samples, zero outside.
double value_at(const Accelerogram& record, double t) {
  const std::vector<double>& a = record.acceleration;
  const double x = t / record.time_step;
  if (!(x >= 0) || a.empty() || x > static_cast<double>(a.size() - 1)) return 0;
  const auto i = static_cast<std::size_t>(x);
  if (i + 1 == a.size()) return a[i];
  return a[i] + (x - static_cast<double>(i)) * (a[i + 1] - a[i]);
}

/// A record of rotation, in rad/s2.
Accelerogram read_rotation(const std::string& name, const MotionComponent& component) {
  RecordedMotion record = std::get<RecordedMotion>(component.source);
  record.unit = "m/s2";  // numbers as they are
  Accelerogram rotation = read_accelerogram(record);
  for (double& a : rotation.acceleration) a *= component.scale;
  if (!(rotation.peak() <= impossible_rotation)) {
    throw UserError(name + ": " + record.file + ": peak " + text_of(rotation.peak()) +
                    " rad/s2 is beyond any ground; correct the file or the scale");
  }
  return rotation;
}

std::string ground_text(const Support& support, std::size_t axis) {
  std::string text = "ground motion";
  if (support.delay > 0) text += ", " + text_of(support.delay) + " s later";
  if (support.factor[axis] != 1) text += ", times " + text_of(support.factor[axis]);
  return text;
}

}  // namespace

SupportMotion::SupportMotion(std::span<const Support> supports, const GroundMotion& ground,
                             Resampling resampling)
    : ground_(ground) {
  for (std::size_t s = 0; s < supports.size(); ++s) {
    names_.push_back(supports[s].name);
    add(s, supports[s], resampling);
  }
}

void SupportMotion::add(std::size_t number, const Support& support, Resampling resampling) {
  std::array<std::optional<MotionComponent>, 3> own{support.motion[0], support.motion[1],
                                                    support.motion[2]};
  const std::string name = "support " + support.name;
  const GroundMotion translations(own, resampling, name + ", motion");
  for (const std::string& doubt : translations.doubts()) doubts_.push_back(doubt);
  auto description = translations.descriptions().begin();
  for (std::size_t c = 0; c < 6; ++c) {
    const auto axis = static_cast<int>(axis_of_motion(c));
    if (!moves_otherwise(support, c, ground_.active(axis))) continue;
    columns_.push_back({static_cast<int>(number), static_cast<int>(c), support.point});
    Source& source = sources_.emplace_back();
    if (support.embedment && axis < 2) {
      source.own = c < 3 ? embedded_translation(ground_.component(axis), *support.embedment)
                         : embedded_rotation(ground_.component(axis), *support.embedment);
      if (c == 3) {  // about x: the top goes with -y
        for (double& a : source.own.acceleration) a = -a;
      }
      source.text = "ground motion at a depth of " + text_of(support.embedment->depth) + " m";
    } else if (c < 3 && !support.motion[c]) {
      source.delay = support.delay;
      source.factor = support.factor[c];
      source.text = ground_text(support, c);
    } else if (c < 3) {
      source.own = translations.component(static_cast<int>(c));
      source.text = (description++)->source;
    } else {
      source.own = read_rotation(name + ", rotation", *support.motion[c]);
      if (resampling == Resampling::band_limited) {
        source.own = resample_band_limited(source.own, resampled_step);
      }
      source.text = std::get<RecordedMotion>(support.motion[c]->source).file;
    }
  }
}

void SupportMotion::evaluate(double t, std::span<double> relative_acceleration) const noexcept {
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const Source& source = sources_[c];
    const int component = columns_[c].component;
    if (!source.own.acceleration.empty()) {
      relative_acceleration[c] = value_at(source.own, t);
    } else {
      relative_acceleration[c] =
          source.factor == 0 ? 0
                             : source.factor * ground_.acceleration(component, t - source.delay);
    }
    if (component < 3) relative_acceleration[c] -= ground_.acceleration(component, t);
  }
}

SupportMotion::Reach SupportMotion::reach(std::size_t column) const {
  const Source& source = sources_[column];
  double end_time = source.own.duration();
  for (int d = 0; d < 3 && columns_[column].component < 3; ++d) {
    end_time = std::max(end_time, source.delay + ground_.component(d).duration());
  }
  Reach reach;
  std::vector<double> now(columns_.size());
  double before = 0;
  double velocity = 0;
  double displacement = 0;
  const auto steps =
      static_cast<std::int64_t>(std::clamp(std::ceil(end_time / coarse_step), 1.0, 1e7));
  const double step = end_time / static_cast<double>(steps);
  for (std::int64_t n = 0; n <= steps; ++n) {
    evaluate(static_cast<double>(n) * step, now);
    if (n > 0) {
      const double mean = (before + now[column]) / 2;
      displacement += step * (velocity + step / 2 * mean);
      velocity += step * mean;
    }
    before = now[column];
    reach.largest = std::max(reach.largest, std::abs(displacement));
    reach.largest_speed = std::max(reach.largest_speed, std::abs(velocity));
    reach.peak = std::max(reach.peak, std::abs(before));
  }
  reach.end = displacement;
  reach.end_velocity = velocity;
  return reach;
}

std::string SupportMotion::describe(std::size_t column) const {
  return "support " + names_[columns_[column].support] + ", " +
         std::string(motion_names[columns_[column].component]);
}

std::vector<std::string> SupportMotion::doubts() const {
  std::vector<std::string> doubts = doubts_;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const Reach way = reach(c);
    const bool turns = columns_[c].component >= 3;
    const std::string unit = turns ? " rad" : " m";
    if (std::abs(way.end_velocity) > resting * way.largest_speed) {
      doubts.push_back(describe(c) + ": once its records are over it goes on at " +
                       text_of(way.end_velocity) + unit + "/s against the ground, its largest is " +
                       text_of(way.largest_speed) + ", and it is " + text_of(way.end) + unit +
                       " away: it drifts off; give records that end at rest");
    } else if (std::abs(way.end) > returned * way.largest) {
      doubts.push_back(describe(c) + ": its records leave it " + text_of(way.end) + unit +
                       " away from where it stood on the ground, its largest is " +
                       text_of(way.largest) + "; is that meant, or the base line of a record?");
    }
  }
  return doubts;
}

}  // namespace pounding
