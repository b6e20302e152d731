#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/petsc.h"
#include "system/linear_system.h"

namespace pounding {

/// What evolves, for one structure; owned dofs of this rank.
struct BodyState {
  std::vector<double> displacement;  ///< u_n [m, rad]
  std::vector<double>
      velocity_half;  ///< v_{n-1/2} before, v_{n+1/2} after the step to t_n [m/s, rad/s]
  std::vector<double> stiffness_argument;  ///< w = u + beta v
  std::vector<double> stiffness_force;     ///< q = K w [N, N m]
  std::vector<double>
      device_force;  ///< of dashpots and tension-only bars; empty without them [N, N m]
};

struct State {
  std::vector<BodyState> bodies;
  std::int64_t step = 0;  ///< n: displacements stand at t_n = n dt, velocities at t_n + dt/2

  explicit State(std::span<const LinearSystem> systems) {
    for (const LinearSystem& system : systems) {
      const std::size_t n = system.lumped_mass.size();
      const std::vector<double> zero(n, 0.0);
      bodies.push_back(
          {zero, zero, zero, zero, system.has_devices() ? zero : std::vector<double>{}});
      for (std::size_t d = 0; d < 3; ++d) {
        for (std::size_t i = 0; i < n; ++i) {
          bodies.back().velocity_half[i] += system.initial_velocity[d] * system.influence[d][i];
        }
      }
    }
  }
};

}  // namespace pounding
