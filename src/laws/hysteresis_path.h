#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "scene/hysteresis.h"

namespace pounding::interactions {

/// Force of a skeleton at an elongation >= 0; nothing where it has no breaks. `elongation` [m].
double skeleton_force(const Skeleton& skeleton, double first_slope, double elongation);

/// Force of a law in one dimension along a path of its elongation, without regard to steps: a
/// straight way from one elongation to the next is followed through all of its corners. Its tangent
/// is never above the first slope k0. Pure.
class HysteresisPath {
 public:
  /// Force [N] and the energy that the law can give back from there on [J].
  struct State {
    double force = 0;
    double stored = 0;
  };

  virtual ~HysteresisPath() = default;
  /// Numbers that it remembers; they start at 0.
  virtual std::size_t memory_size() const = 0;
  /// Goes from elongation `from` to `to` [m], `from` being where it went last. `strength`: of the
  /// forces of the skeleton beyond its first line, which sliders alone can follow; 1 of all others.
  virtual State follow(double from, double to, std::span<double> memory, double strength) const = 0;
};

/// Path of a law by its rule.
std::unique_ptr<HysteresisPath> make_path(const Hysteresis& law);

}  // namespace pounding::interactions
