#pragma once

#include <vector>

#include "interactions/laws/hysteresis_path.h"

namespace pounding::interactions {

/// Path of kinematic hardening: a spring of the last slope and, in parallel, springs each in series
/// with a slider, one for each break of the skeleton,
///
///     F = r e + sum_i q_i,     q_i = k_i (e - p_i) within s [-Q_i-, Q_i+]
///
/// s the strength, k_i the slope lost at the break and Q_i = k_i times its elongation. Slopes must
/// not grow, and be the same in both directions.
class SliderPath final : public HysteresisPath {
 public:
  explicit SliderPath(const Hysteresis& law);

  /// p_i of each slider.
  std::size_t memory_size() const override { return sliders_.size(); }
  State follow(double from, double to, std::span<double> memory, double strength) const override;

 private:
  struct Slider {
    double stiffness = 0;
    double most = 0;   ///< Q+
    double least = 0;  ///< -Q-
  };
  std::vector<Slider> sliders_;
  double last_slope_;
};

}  // namespace pounding::interactions
