#include "motion/support_motion.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "common/error.h"
#include "common/types.h"
#include "motion/fourier.h"
#include "motion/records/record_text.h"
#include "scene/support_reader.h"

namespace pounding {
namespace {

/// Beyond the rotation of any foundation [rad/s2]: its edge at 1 m would have ten thousand g.
constexpr double impossible_rotation = impossible_peak;

/// Parts of the largest velocity, and of the largest displacement, that may be left at the end.
constexpr double still_moving = 0.05;
constexpr double returned = 0.5;

/// Steps of the rule that finds how far a support moves.
constexpr double coarse_step = 1e-3;  // s

/// A record of rotation, in rad/s2.
Accelerogram read_rotation(const std::string& name, const MotionComponent& component) {
  RecordedMotion record = std::get<RecordedMotion>(component.source);
  record.unit = "m/s2";  // numbers as they are
  Accelerogram rotation = read_accelerogram(record);
  for (double& a : rotation.acceleration) a *= component.scale;
  refuse_if(!(rotation.peak() <= impossible_rotation),
            name + ": " + record.file + ": peak " + text_of(rotation.peak()) +
                " rad/s2 is beyond any ground; correct the file or the scale");
  return rotation;
}

/// A record of its own: file, component and the time at which it sets in.
std::string text_of_own(const std::string& file, const std::string& component, double start) {
  std::string text = file;
  if (!component.empty()) text += ", component " + component;
  if (start != 0) text += ", sets in at " + text_of(start) + " s";
  return text;
}

std::string ground_text(const Support& support, std::size_t axis) {
  std::string text = "ground motion";
  if (support.delay > 0) text += ", " + text_of(support.delay) + " s later";
  if (support.factor[axis] != 1) text += ", times " + text_of(support.factor[axis]);
  return text;
}

constexpr double largest_rotation = 0.26;
/// a0 beyond which the factors are constant.
constexpr double end_of_translation = 1.1;
constexpr double end_of_rotation = std::numbers::pi / 2;

/// Times of travel D / V_s after which nothing is left of the filter.
constexpr double memory = 50;

/// Adds the samples that the filter puts before t = 0, found at the end of the period, to two later
/// ones, so that velocity and displacement end as they would. `half`: the share of the first sample
/// that straight lines between samples lose.
void fold(std::vector<double>& samples, std::size_t tail, double half) {
  double sum = half;
  double moment = 0;
  for (std::size_t k = 1; k <= tail; ++k) {
    const double before = samples[samples.size() - k];
    sum += before;
    moment -= static_cast<double>(k) * before;
  }
  const std::size_t far = std::max<std::size_t>(tail, 2);
  const double there = (moment - sum) / static_cast<double>(far - 1);
  samples[1] += sum - there;
  samples[far] += there;
}

/// The signal by a real factor at each circular frequency, with zeros around it.
template <typename Factor>
Accelerogram filtered(const Accelerogram& signal, double travel, const Factor& factor) {
  const double step = signal.time_step;
  const auto tail = static_cast<std::size_t>(std::ceil(memory * travel / step));
  Accelerogram result;
  if (signal.acceleration.empty()) return result;
  result.time_step = step;
  result.start = signal.start;
  std::vector<double>& samples = result.acceleration;
  const std::size_t kept = signal.acceleration.size() + tail;
  const int n = good_fourier_size(static_cast<int>(kept + tail + 3));
  samples = signal.acceleration;
  samples.resize(static_cast<std::size_t>(n), 0.0);
  std::vector<std::complex<double>> spectrum = fourier(samples);
  for (std::size_t k = 0; k < spectrum.size(); ++k) {
    spectrum[k] *= factor(2 * std::numbers::pi * static_cast<double>(k) / (n * step) * travel);
  }
  samples = inverse_fourier(spectrum, n);
  fold(samples, tail, (samples[0] - factor(0) * signal.acceleration.front()) / 2);
  samples.resize(std::max<std::size_t>(kept, 3));
  return result;
}

}  // namespace

/// Records of a support's own, their times not yet counted from the origin of all.
struct SupportMotion::Records {
  GroundMotion translations;
  std::array<Accelerogram, 3> rotations{};

  double earliest(double first) const {
    first = std::min(first, translations.earliest().value_or(first));
    for (const Accelerogram& rotation : rotations) {
      if (!rotation.acceleration.empty()) first = std::min(first, rotation.start);
    }
    return first;
  }

  void count_times_from(double origin) {
    translations.count_times_from(origin);
    for (Accelerogram& rotation : rotations) rotation.start -= origin;
  }
};

SupportMotion::SupportMotion(std::span<const Support> supports, GroundMotion& ground,
                             Resampling resampling)
    : ground_(ground) {
  constexpr double none = std::numeric_limits<double>::infinity();
  std::vector<Records> all;
  double origin = ground.earliest().value_or(none);
  for (const Support& support : supports) {
    all.push_back(read(support, resampling));
    origin = all.back().earliest(origin);
  }
  if (origin == none) origin = 0;
  ground.count_times_from(origin);
  for (std::size_t s = 0; s < supports.size(); ++s) {
    all[s].count_times_from(origin);
    names_.push_back(supports[s].name);
    add(s, supports[s], all[s]);
  }
}

SupportMotion::Records SupportMotion::read(const Support& support, Resampling resampling) {
  const std::array<std::optional<MotionComponent>, 3> own{support.motion[0], support.motion[1],
                                                          support.motion[2]};
  const std::string name = "support " + support.name;
  Records records{GroundMotion(own, resampling, name + ", motion")};
  for (const std::string& doubt : records.translations.doubts()) doubts_.push_back(doubt);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!support.motion[axis + 3]) continue;
    Accelerogram rotation = read_rotation(name + ", rotation", *support.motion[axis + 3]);
    for (const std::string& doubt : rotation.doubts) {
      doubts_.push_back(name + ", rotation " + direction_names[axis] + ": " + doubt);
    }
    records.rotations[axis] = resampling == Resampling::band_limited
                                  ? resample_band_limited(rotation, resampled_step)
                                  : std::move(rotation);
  }
  return records;
}

void SupportMotion::add(std::size_t number, const Support& support, const Records& records) {
  auto description = records.translations.descriptions().begin();
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
      source.own = records.translations.component(static_cast<int>(c));
      source.text = text_of_own(description->source, description->component, source.own.start);
      ++description;
    } else {
      source.own = records.rotations[c - 3];
      source.text = text_of_own(std::get<RecordedMotion>(support.motion[c]->source).file, "",
                                source.own.start);
    }
  }
}

void SupportMotion::evaluate(double t, std::span<double> relative_acceleration) const noexcept {
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const Source& source = sources_[c];
    const int component = columns_[c].component;
    if (!source.own.acceleration.empty()) {
      relative_acceleration[c] = source.own.at(t);
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
  double end_time = source.own.end();
  for (int d = 0; d < 3 && columns_[column].component < 3; ++d) {
    end_time = std::max(end_time, source.delay + ground_.component(d).end());
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
    if (std::abs(way.end_velocity) > still_moving * way.largest_speed) {
      doubts.push_back(describe(c) + ": once its records are over it goes on at " +
                       text_of(way.end_velocity) + unit + "/s against the ground, its largest is " +
                       text_of(way.largest_speed) + ", and it is " + text_of(way.end) + unit +
                       " away: it drifts off; give records that end at rest");
    } else if (std::abs(way.end) > returned * way.largest) {
      doubts.push_back(describe(c) + ": its records leave it " + text_of(way.end) + unit +
                       " away from its first place on the ground, its largest is " +
                       text_of(way.largest) + "; is that meant, or the base line of a record?");
    }
  }
  return doubts;
}

Accelerogram embedded_translation(const Accelerogram& surface, const Embedment& embedment) {
  return filtered(surface, embedment.travel(),
                  [](double a0) { return std::cos(std::min(a0, end_of_translation)); });
}

Accelerogram embedded_rotation(const Accelerogram& surface, const Embedment& embedment) {
  const double largest = largest_rotation / embedment.half_width;
  return filtered(surface, embedment.travel(), [largest](double a0) {
    return largest * (1 - std::cos(std::min(a0, end_of_rotation)));
  });
}

}  // namespace pounding
