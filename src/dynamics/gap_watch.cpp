#include "dynamics/gap_watch.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pounding {

GapWatch::GapWatch(std::span<const LinearSystem> systems, std::vector<Bound> bounds,
                   const Vector3& peaks, double time_step)
    : time_step_(time_step),
      coordinates_(systems.size()),
      measured_(2 * systems.size(), 0.0),
      root_energy_(systems.size(), 0.0) {
  for (std::size_t s = 0; s < systems.size(); ++s) {
    const Vector3& g = systems[s].gravity;
    rate_norm_.push_back(bounds[s].rate_norm);
    double growth = time_step * bounds[s].rest_norm.value_or(0);
    for (std::size_t d = 0; d < 3; ++d) {
      const double weight = bounds[s].rest_norm ? 0 : std::abs(g[d]);
      growth += time_step * (peaks[d] + weight) * bounds[s].force_norm[d];
    }
    growth_.push_back(growth);
    possible_ = possible_ && std::isfinite(bounds[s].rate_norm);
    if (goes_by_coordinates(systems[s])) {
      coordinates_[s] =
          std::make_unique<CoordinateRates>(systems[s], std::move(bounds[s].coordinate_rows),
                                            std::hypot(peaks[0], peaks[1], peaks[2]), time_step);
      measures_ = true;
    } else {
      needs_energy_ = true;
    }
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
  energy_step_ = saved.whole("gap_watch_steps", steps[0]);
  last_touch_ = saved.whole("gap_watch_steps", steps[1]);
  next_look_ = saved.whole("gap_watch_steps", steps[2]);
}

void GapWatch::energies_known(std::int64_t step, std::span<const StructureEnergy> energies,
                              std::span<const double> round_off) {
  energy_step_ = step;
  for (std::size_t s = 0; s < energies.size(); ++s) {
    // Round-off of a structure at rest, or far from its place, must not count as knowledge that
    // nothing moves.
    root_energy_[s] = std::sqrt(2 * (std::max(0.0, energies[s].held) + round_off[s])) * (1 + 1e-6);
  }
}

std::span<double> GapWatch::measure(std::span<const StructureState> structures) {
  for (std::size_t s = 0; s < structures.size(); ++s) {
    if (coordinates_[s]) {
      measured_[2 * s] = coordinates_[s]->rate(structures[s]);
      measured_[2 * s + 1] = coordinates_[s]->growth();
    }
  }
  return measured_;
}

double GapWatch::rate_bound(std::int64_t look, std::int64_t step) const {
  double rate = 0;
  for (std::size_t s = 0; s < growth_.size(); ++s) {
    if (coordinates_[s]) {
      rate += measured_[2 * s] + measured_[2 * s + 1] * static_cast<double>(step + 2 - look);
    } else {
      const double root =
          root_energy_[s] + growth_[s] * static_cast<double>(step + 2 - energy_step_);
      rate += rate_norm_[s] * root;
    }
  }
  return rate;
}

void GapWatch::looked(std::int64_t step, double clearance, bool touching) {
  if (touching) last_touch_ = step;
  next_look_ = step + 1;
  const bool known = !touching && step > 0 && (!needs_energy_ || energy_step_ > last_touch_);
  if (!possible_ || clearance <= 0 || !known) return;
  // The bound rises with time: its value at the last step holds for all steps before.
  const auto reaches = [&](std::int64_t steps) {
    return time_step_ * static_cast<double>(steps) * rate_bound(step, step + steps) >= clearance;
  };
  std::int64_t low = 1;
  while (low < 100000 && !reaches(2 * low)) low *= 2;
  std::int64_t high = 2 * low;
  while (high - low > 1) {
    const std::int64_t middle = low + (high - low) / 2;
    (reaches(middle) ? high : low) = middle;
  }
  if (!reaches(low)) next_look_ = step + low;
}

}  // namespace pounding
