#include "interactions/laws/slider_path.h"

#include <algorithm>

namespace pounding::interactions {

SliderPath::SliderPath(const Hysteresis& law) : last_slope_(law.positive.last_slope) {
  const auto& plus = law.positive.breaks;
  const auto& minus = law.negative.breaks;
  double slope = law.first_slope();
  for (std::size_t i = 0; i < plus.size(); ++i) {
    const double next = i + 1 < plus.size() ? (plus[i + 1].force - plus[i].force) /
                                                  (plus[i + 1].elongation - plus[i].elongation)
                                            : last_slope_;
    const double lost = slope - next;
    sliders_.push_back({lost, lost * plus[i].elongation, -lost * minus[i].elongation});
    slope = next;
  }
}

HysteresisPath::State SliderPath::follow(double /*from*/, double to, std::span<double> memory,
                                         double strength) const {
  State state{last_slope_ * to, last_slope_ * to * to / 2};
  for (std::size_t i = 0; i < sliders_.size(); ++i) {
    const Slider& slider = sliders_[i];
    double force = slider.stiffness * (to - memory[i]);
    if (force > strength * slider.most || force < strength * slider.least) {
      force = std::clamp(force, strength * slider.least, strength * slider.most);
      memory[i] = to - force / slider.stiffness;
    }
    state.force += force;
    if (slider.stiffness > 0) state.stored += force * force / (2 * slider.stiffness);
  }
  return state;
}

}  // namespace pounding::interactions
