#pragma once

#include <vector>

namespace pounding::interactions {

/// Motion of supports relative to the scene's ground, per column of SupportShapes; empty where the
/// ground moves as one. Before the step to t_n:
struct SupportState {
  std::vector<double> displacement;  ///< r_n [m, rad]
  std::vector<double> velocity;      ///< r'_{n-1/2} [m/s, rad/s]
};

/// Motion of the supports in one step, per column of SupportShapes; empty where the ground moves as
/// one. It goes by the scheme of the structures, so that supports which all move alike give what a
/// common ground gives:
///
///     r'_{n+1/2} = r'_{n-1/2} + h r''_n,      r_{n+1} = r_n + dt r'_{n+1/2}
///
/// with h = dt, but dt / 2 in the first step.
struct SupportStep {
  std::vector<double> acceleration;     ///< r''_n [m/s2, rad/s2]
  std::vector<double> displacement;     ///< r_n [m, rad]
  std::vector<double> velocity_before;  ///< r'_{n-1/2} [m/s, rad/s]
  std::vector<double> velocity;         ///< r'_{n+1/2}
  std::vector<double> velocity_mean;    ///< of these two

  explicit SupportStep(std::size_t columns)
      : acceleration(columns, 0.0),
        displacement(columns, 0.0),
        velocity_before(columns, 0.0),
        velocity(columns, 0.0),
        velocity_mean(columns, 0.0) {}

  /// Before the step to t_n, `acceleration` being known; `duration`: h [s].
  void begin(const SupportState& state, double duration) {
    displacement = state.displacement;
    velocity_before = state.velocity;
    for (std::size_t c = 0; c < acceleration.size(); ++c) {
      velocity[c] = velocity_before[c] + duration * acceleration[c];
      velocity_mean[c] = (velocity_before[c] + velocity[c]) / 2;
    }
  }
  /// After it.
  void finish(double time_step, SupportState& state) const {
    state.velocity = velocity;
    for (std::size_t c = 0; c < velocity.size(); ++c) {
      state.displacement[c] += time_step * velocity[c];
    }
  }
};

}  // namespace pounding::interactions
