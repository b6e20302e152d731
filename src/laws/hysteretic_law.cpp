#include "laws/hysteretic_law.h"

#include <cmath>

namespace pounding::interactions {
namespace {

constexpr double of_energies = 1e-14;  ///< round-off over their largest part

double first_elongation(const Skeleton& skeleton) {
  return skeleton.breaks.empty() ? 0 : skeleton.breaks.front().elongation;
}

}  // namespace

HystereticLaw::HystereticLaw(const Hysteresis& law)
    : stiffness_(law.first_slope()),
      flexibility_(law.flexibility),
      first_plus_(first_elongation(law.positive)),
      first_minus_(first_elongation(law.negative)),
      path_(make_path(law)) {}

void HystereticLaw::advance(double elongation, std::span<double> memory, double strength) const {
  const bool was_elastic = is_elastic(memory);
  const auto note = [&](double first, double reached, double& most) {
    if (first > 0) most = std::max(most, reached / (strength * first));
  };
  note(first_plus_, elongation, memory[most_plus]);
  note(first_minus_, -elongation, memory[most_minus]);
  if (is_elastic(memory)) {
    memory[force_now] = memory[on_path] = stiffness_ * elongation;
  } else {
    // The path begins where it leaves its first line.
    if (was_elastic) path_->follow(0, memory[elongation_now], memory.subspan(of_the_law), 1);
    yield(elongation, memory, strength);
    if (flexibility_ > 0) {
      const double rest = 1 - flexibility_ * stiffness_;
      const double own = elongation - flexibility_ * memory[on_path];
      note(rest * first_plus_, own, memory[most_plus]);
      note(rest * first_minus_, -own, memory[most_minus]);
    }
  }
  memory[elongation_now] = elongation;
}

void HystereticLaw::yield(double elongation, std::span<double> memory, double strength) const {
  const double way = elongation - memory[elongation_now];
  const auto [wanted, stored] =
      path_->follow(memory[elongation_now], elongation, memory.subspan(of_the_law), strength);
  const double before = memory[force_now];
  const double elastic = before + stiffness_ * way;
  const double extra = std::max(0.0, stored - wanted * wanted / (2 * stiffness_));
  // Work of the mean force and U, less f^2 / (2 k0) held anew.
  const auto left = [&](double force) {
    return (force + before) * (elastic - force) / (2 * stiffness_) + memory[beyond];
  };
  const double scale = (before * before + elastic * elastic + wanted * wanted) / (2 * stiffness_) +
                       memory[beyond] + extra;
  double force = wanted;
  if (left(wanted) < -of_energies * scale) {
    const double middle = stiffness_ * way / 2;
    const double reach = std::sqrt(std::pow(before + middle, 2) + 2 * stiffness_ * memory[beyond]);
    force = std::clamp(wanted, middle - reach, middle + reach);
  }
  const double held = left(force);
  const double kept = held >= extra - of_energies * scale ? extra : std::max(0.0, held);
  memory[lost_so_far] += held - kept;
  memory[beyond] = kept;
  memory[force_now] = force;
  memory[on_path] = wanted;
}

}  // namespace pounding::interactions
