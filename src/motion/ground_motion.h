#pragma once

#include <array>
#include <optional>

#include "common/types.h"
#include "motion/accelerogram.h"
#include "scene/scene.h"

namespace pounding {

/// Ground acceleration a_g(t) in the three directions: each component is read or generated, scaled
/// (so that the peak of its samples is `pga`, or by `scale`), resampled if asked, and linear
/// between samples. It is zero before t = 0, after its last sample, and in directions without a
/// component.
class GroundMotion {
 public:
  /// Reads the files; every rank may do so, or one that shares the result. Band-limited resampling
  /// goes to steps of 5e-4 s or less. Throws UserError (see read_accelerogram,
  /// generate_accelerogram; a pga for a record that is zero; a synthetic motion without pga).
  GroundMotion(const std::array<std::optional<MotionComponent>, 3>& components,
               Resampling resampling);

  /// a_g [m/s2] in direction 0, 1 or 2 at time t [s].
  double acceleration(int direction, double t) const noexcept {
    const auto& samples = components_[static_cast<std::size_t>(direction)];
    const double x = t / samples.time_step;
    const std::size_t size = samples.acceleration.size();
    if (!(x >= 0) || size == 0 || x > static_cast<double>(size - 1)) return 0;
    const auto i = static_cast<std::size_t>(x);
    const double a = samples.acceleration[i];
    if (i + 1 == size) return a;
    return a + (x - static_cast<double>(i)) * (samples.acceleration[i + 1] - a);
  }

  /// The three components [m/s2] at time t [s].
  void evaluate(double t, Vector3& ground_acceleration) const noexcept {
    for (int direction = 0; direction < 3; ++direction)
      ground_acceleration[static_cast<std::size_t>(direction)] = acceleration(direction, t);
  }

  bool active(int direction) const {
    return !components_[static_cast<std::size_t>(direction)].acceleration.empty();
  }

  /// Samples applied in a direction; empty when it has no component.
  const Accelerogram& component(int direction) const {
    return components_[static_cast<std::size_t>(direction)];
  }

  /// Largest |acceleration| of each component [m/s2].
  Vector3 peaks() const;
  /// Bound of |a_g| at all times: the norm of the components' peaks, which may coincide [m/s2].
  double peak_acceleration() const;
  double end_time() const;  ///< last sample of the longest component [s]; 0 without any

 private:
  std::array<Accelerogram, 3> components_{Accelerogram{{}, 1}, Accelerogram{{}, 1},
                                          Accelerogram{{}, 1}};
};

}  // namespace pounding
