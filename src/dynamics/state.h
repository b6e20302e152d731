#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/memory.h"
#include "common/saved_state.h"
#include "system/linear_system.h"

namespace pounding {

/// What evolves, for one structure; owned dofs of this rank. Before the step to t_n:
struct BodyState {
  std::vector<double> displacement;            ///< u_n [m, rad]
  std::vector<double> velocity;                ///< v_{n-1/2} [m/s, rad/s]
  std::vector<double> stiffness_displacement;  ///< K u_{n-1} [N, N m]
  std::vector<double> device_force;            ///< of dashpots in the step; empty without them
};

struct State {
  std::vector<BodyState> bodies;
  std::int64_t step = 0;  ///< n of the next step

  explicit State(std::span<const LinearSystem> systems) {
    for (const LinearSystem& system : systems) {
      const std::size_t dofs = system.lumped_mass.size();
      const std::vector<double> device(system.has_devices() ? dofs : 0, 0.0);
      bodies.push_back({zeros_on_large_pages(dofs), zeros_on_large_pages(dofs),
                        zeros_on_large_pages(dofs), device});
      for (std::size_t d = 0; d < 3; ++d) {
        const std::vector<double> iota = system.influence(static_cast<int>(d));
        for (std::size_t i = 0; i < iota.size(); ++i) {
          bodies.back().displacement[i] += iota[i] * system.initial_displacement[d];
          bodies.back().velocity[i] += iota[i] * system.initial_velocity[d];
        }
      }
    }
  }

  void save(SavedState& saved) const {
    saved.put("step", {static_cast<double>(step - 1)});  // the last one made
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      saved.put_dofs(static_cast<int>(b), "displacement", bodies[b].displacement);
      saved.put_dofs(static_cast<int>(b), "velocity", bodies[b].velocity);
      saved.put_dofs(static_cast<int>(b), "stiffness_displacement",
                     bodies[b].stiffness_displacement);
    }
  }
  void load(const SavedState& saved) {
    step = saved.integer("step") + 1;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      saved.get_dofs(static_cast<int>(b), "displacement", bodies[b].displacement);
      saved.get_dofs(static_cast<int>(b), "velocity", bodies[b].velocity);
      saved.get_dofs(static_cast<int>(b), "stiffness_displacement",
                     bodies[b].stiffness_displacement);
    }
  }
};

}  // namespace pounding
