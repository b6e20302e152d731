#include "solvers/friction_point.h"

#include <algorithm>

#include "common/array_reductions.h"

namespace pounding::interactions {
namespace {

/// Coupling of a point's normal and tangents below which it is round-off.
constexpr double no_coupling = 1e-14;

/// The nearest point of a disk.
Tangents onto_disk(double x, double y, double radius) {
  const double length = size(x, y);
  if (length <= radius) return {x, y};
  return {x * (radius / length), y * (radius / length)};
}

}  // namespace

void solve_on_disk(const double (&matrix)[3], const double (&rate)[2], double radius,
                   double (&impulse)[2]) {
  // Principal axes of A.
  const double mean = (matrix[0] + matrix[2]) / 2;
  const double half = (matrix[0] - matrix[2]) / 2;
  const double spread = size(half, matrix[1]);
  const double angle = std::atan2(matrix[1], half) / 2;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const Tangents stiffness{mean + spread, mean - spread};
  const Tangents turned{c * rate[0] + s * rate[1], c * rate[1] - s * rate[0]};
  const double least = 8 * epsilon * stiffness[0];
  Tangents x{0, 0};
  const auto at = [&](double shift) {
    for (std::size_t d = 0; d < 2; ++d) {
      x[d] = stiffness[d] > least ? -turned[d] / (stiffness[d] + shift) : 0;
    }
    return size(x[0], x[1]);
  };
  double length = at(0);
  double shift = 0;
  for (int i = 0; i < 60 && length > radius * (1 + 2 * epsilon); ++i) {
    double slope = 0;
    for (std::size_t d = 0; d < 2; ++d) {
      if (stiffness[d] > least) slope += x[d] * x[d] / (stiffness[d] + shift);
    }
    shift += (length * length / slope) * ((length - radius) / radius);
    length = at(shift);
  }
  if (length > radius) x = onto_disk(x[0], x[1], radius);
  impulse[0] = c * x[0] - s * x[1];
  impulse[1] = s * x[0] + c * x[1];
}

FrictionPoint::FrictionPoint(const SparseRows& delassus, std::size_t number) : first(3 * number) {
  for (std::size_t d = 0; d < 3; ++d) {
    const std::span<const int> columns = delassus.columns(first + d);
    const auto own = std::ranges::lower_bound(columns, static_cast<int>(first));
    std::copy_n(&delassus.values(first + d)[own - columns.begin()], 3, &block_[3 * d]);
  }
}

bool FrictionPoint::isotropic() const {
  const double small = no_coupling * tangential();
  return std::abs(h(1, 2)) <= small && std::abs(h(1, 1) - h(2, 2)) <= small;
}

bool FrictionPoint::uncoupled() const {
  const double small = no_coupling * std::sqrt(normal() * tangential());
  return std::abs(h(0, 1)) <= small && std::abs(h(0, 2)) <= small;
}

Tangents FrictionPoint::slide(const Tangents& rate, double radius) const {
  const double mobility = tangential();
  if (!(mobility > 0) || !(radius > 0)) return {0, 0};
  if (isotropic()) return onto_disk(-rate[0] / mobility, -rate[1] / mobility, radius);
  double impulse[2];
  solve_on_disk({h(1, 1), (h(1, 2) + h(2, 1)) / 2, h(2, 2)}, {rate[0], rate[1]}, radius, impulse);
  return {impulse[0], impulse[1]};
}

double FrictionPoint::natural_map(double coefficient, const double* rate,
                                  const double* impulse) const {
  double worst = 0;
  if (normal() > 0) worst = std::abs(std::min(impulse[0] * normal(), rate[0]));
  const double t = tangential();
  const double radius = coefficient * std::max(0.0, impulse[0]);
  if (t > 0) {
    const Tangents on = onto_disk(impulse[1] - rate[1] / t, impulse[2] - rate[2] / t, radius);
    worst = std::max(worst, t * size(impulse[1] - on[0], impulse[2] - on[1]));
  }
  return worst;
}

}  // namespace pounding::interactions
