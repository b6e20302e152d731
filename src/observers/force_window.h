#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/saved_state.h"

namespace pounding {

/// Largest force of a contact over a stated time: the largest impulse within any time of that
/// length over the length, the impulse of a step being spread evenly over it. Unlike the largest
/// impulse of one step over the step it has a limit as the step goes to zero.
class ForceWindow {
 public:
  /// `length` of the time [s]; steps last `time_step` at most but for round-off, which bounds the
  /// memory taken here.
  ForceWindow(double length, double time_step);

  /// A step from `start` to `end` [s] with `impulse` > 0 [N s]; steps in order, those without
  /// impulse left out.
  void add(double start, double end, double impulse);
  /// Over all times since `reset` [N].
  double largest() const { return largest_; }
  void reset();

  /// A table of the largest force and the steps that still count.
  void keep(const std::string& name, const StateKeeper& state);

 private:
  /// A step with an impulse; the impulse of all since `reset` at its two ends [N s].
  struct Step {
    double start = 0;
    double end = 0;
    double before = 0;
    double after = 0;
  };
  static double at(const Step& step, double time);

  double length_;
  std::vector<Step> steps_;  ///< those from first_ on end within the length before the last end
  std::size_t first_ = 0;
  double largest_ = 0;
};

}  // namespace pounding
