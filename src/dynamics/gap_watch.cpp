#include "dynamics/gap_watch.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pounding {

GapWatch::GapWatch(std::span<const LinearSystem> systems, std::span<const double> margins,
                   std::span<const double> rate_norms, double peak_acceleration, double time_step)
    : time_step_(time_step), root_energy_(systems.size(), 0.0) {
  for (std::size_t s = 0; s < systems.size(); ++s) {
    // Tension-only bars hold energy that the bound does not know of.
    possible_ = possible_ && !systems[s].tension_bars;
    possible_ = possible_ && margins[s] > 0;
    const double root = std::sqrt(std::max(margins[s], 1e-300));
    rate_per_root_energy_.push_back(rate_norms[s] / root);
    const Vector3& g = systems[s].gravity;
    const double acceleration = peak_acceleration + std::hypot(g[0], g[1], g[2]);
    growth_.push_back(std::sqrt(systems[s].total_mass) * acceleration * time_step / root);
  }
}

void GapWatch::save(SavedState& saved) const {
  saved.put("gap_watch_root_energy", root_energy_);
  saved.put("gap_watch_steps", {static_cast<double>(energy_step_), static_cast<double>(last_touch_),
                                static_cast<double>(next_look_)});
}

void GapWatch::load(const SavedState& saved) {
  saved.get("gap_watch_root_energy", root_energy_);
  std::array<double, 3> steps{};
  saved.get("gap_watch_steps", steps);
  energy_step_ = static_cast<std::int64_t>(steps[0]);
  last_touch_ = static_cast<std::int64_t>(steps[1]);
  next_look_ = static_cast<std::int64_t>(steps[2]);
}

void GapWatch::energies_known(std::int64_t step, std::span<const StructureEnergy> energies) {
  energy_step_ = step;
  for (std::size_t s = 0; s < energies.size(); ++s) {
    // Round-off of a structure at rest must not count as knowledge that nothing moves.
    root_energy_[s] = std::sqrt(2 * std::max(0.0, energies[s].energy())) * (1 + 1e-6);
  }
}

double GapWatch::rate_bound(std::int64_t step) const {
  double rate = 0;
  for (std::size_t s = 0; s < growth_.size(); ++s) {
    const double root = root_energy_[s] + growth_[s] * static_cast<double>(step + 2 - energy_step_);
    rate += rate_per_root_energy_[s] * root;
  }
  return rate;
}

void GapWatch::looked(std::int64_t step, double clearance, bool touching) {
  if (touching) {
    last_touch_ = step;
  }
  next_look_ = step + 1;
  if (!possible_ || clearance <= 0 || energy_step_ <= last_touch_) {
    return;
  }
  // The bound rises with time: its value at the last step holds for all steps before.
  std::int64_t steps = 1;
  while (steps < 100000 &&
         time_step_ * static_cast<double>(2 * steps) * rate_bound(step + 2 * steps) < clearance) {
    steps *= 2;
  }
  if (time_step_ * static_cast<double>(steps) * rate_bound(step + steps) < clearance) {
    next_look_ = step + steps;
  }
}

}  // namespace pounding
