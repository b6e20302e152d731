#pragma once

#include <vector>

#include <gtest/gtest.h>

#include "laws/link_law.h"

namespace pounding::interactions {

/// Explicit steps of a mass on a spring, at 0.999 and 0.3 of the stable step, beside a law: the
/// energy of all three never grows but for round-off, however stiff the law is. `start`: memory of the
/// law at the start; `dt` [s].
inline void expect_energy_never_grows(const LinkLaw& law, const std::vector<double>& start,
                                      double dt, int steps) {
  const double mass = 1;
  for (const double part : {0.999, 0.3}) {
    const double stiffness = part * part * 4 * mass / (dt * dt);
    std::vector<double> memory = start;
    double position = 0;
    double velocity = 1;
    double first = 0;
    double last = 0;
    for (int n = 0; n < steps; ++n) {
      const double before = -dt * velocity;  // counted from the position
      const double total = mass * velocity * velocity / 2 +
                           stiffness * (position + before) * position / 2 +
                           law.energy(before, 0, memory);
      if (n == 0) first = last = total;
      // A mass in the law 1e8 times this one takes eight digits of its motion.
      ASSERT_LE(total, last + 1e-10 * first) << n;
      last = total;
      const double free = dt * (velocity - dt * stiffness * position / mass);
      const double force = law.solve(before, 0, free, dt * dt / mass, memory);
      const double after = free - dt * dt / mass * force;
      law.remember(before, 0, after, 1, memory);
      velocity = after / dt;
      position += after;
    }
  }
}

}  // namespace pounding::interactions
