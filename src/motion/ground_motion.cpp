#include "motion/ground_motion.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/error.h"
#include "motion/resampling.h"
#include "motion/synthetic.h"

namespace pounding {

namespace {

constexpr double resampled_step = 5e-4;  // s

Accelerogram make_component(const MotionComponent& component, const std::string& name) {
  const double pga = component.pga, scale = component.scale;
  if (!std::isfinite(pga) || pga < 0)
    throw UserError(name + ": pga " + std::to_string(pga) + " must be positive [m/s2]");
  if (!std::isfinite(scale))
    throw UserError(name + ": scale " + std::to_string(scale) + " must be a finite number");
  if (pga > 0 && scale != 1)
    throw UserError(name + ": pga " + std::to_string(pga) + " and scale " + std::to_string(scale) +
                    " exclude one another; give one of them");

  if (const auto* synthetic = std::get_if<SyntheticMotion>(&component.source)) {
    if (pga == 0) throw UserError(name + ": a synthetic motion needs a pga [m/s2]");
    return generate_accelerogram(read_target_spectrum(synthetic->target), *synthetic, pga);
  }
  const auto& record = std::get<RecordedMotion>(component.source);
  Accelerogram accelerogram = read_accelerogram(record);
  double factor = scale;
  if (pga > 0) {
    factor = pga / accelerogram.peak();
    if (!std::isfinite(factor))
      throw UserError(name + ": " + record.file +
                      " is zero throughout and cannot be scaled to pga " + std::to_string(pga) +
                      "; leave pga out or give another record");
  }
  for (double& a : accelerogram.acceleration) a *= factor;
  return accelerogram;
}

}  // namespace

GroundMotion::GroundMotion(const std::array<std::optional<MotionComponent>, 3>& components,
                           Resampling resampling) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!components[i]) continue;
    components_[i] = make_component(*components[i], std::string("motion ") + direction_names[i]);
    if (resampling == Resampling::band_limited)
      components_[i] = resample_band_limited(components_[i], resampled_step);
  }
}

Vector3 GroundMotion::peaks() const {
  return {components_[0].peak(), components_[1].peak(), components_[2].peak()};
}

double GroundMotion::peak_acceleration() const {
  const Vector3 peak = peaks();
  return std::hypot(peak[0], peak[1], peak[2]);
}

double GroundMotion::end_time() const {
  double end = 0;
  for (const auto& component : components_) end = std::max(end, component.duration());
  return end;
}

}  // namespace pounding
