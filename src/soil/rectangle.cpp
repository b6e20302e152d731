#include "soil/rectangle.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pounding {
namespace {

/// Six numbers along x, y, z and about x, y, z of a mat whose longer side lies along x.
using Six = std::array<double, 6>;

/// Static stiffness at the surface over G B, and G B^3 of the last three. `r` = L / B >= 1.
Six static_stiffness(double r, double nu) {
  return {(6.8 * std::pow(r, 0.65) + 2.4) / (2 - nu),
          (6.8 * std::pow(r, 0.65) + 0.8 * r + 1.6) / (2 - nu),
          (3.1 * std::pow(r, 0.75) + 1.6) / (1 - nu),
          (3.2 * r + 0.8) / (1 - nu),
          (3.73 * std::pow(r, 2.4) + 0.27) / (1 - nu),
          4.25 * std::pow(r, 2.45) + 4.06};
}

/// Factors of embedment; `d` = D / B.
Six embedment_factors(double r, double d) {
  const double along = 1 + (0.33 + 1.34 / (1 + r)) * std::pow(d, 0.8);
  return {along,
          along,
          1 + (0.25 + 0.25 / r) * std::pow(d, 0.8),
          1 + d + 1.6 / (0.35 + r) * d * d,
          1 + d + 1.6 / (0.35 + std::pow(r, 4)) * d * d,
          1 + (1.3 + 1.32 / r) * std::pow(d, 0.9)};
}

/// Real part K (1 - share x / (turn + x)), x = a0^2.
struct Softening {
  double share = 0;  ///< 0: none
  double turn = 1;
};

std::array<Softening, 6> softenings(double r) {
  return {{{},
           {},
           {0.4 + 0.2 / r, 10 / (1 + 3 * (r - 1))},
           {0.55 + 0.01 * std::sqrt(r - 1), 2.4 - 0.4 / (r * r * r)},
           {0.55, 0.6 + 1.4 / (r * r * r)},
           {0.33 - 0.03 * std::sqrt(r - 1), 0.8 / (1 + 0.33 * (r - 1))}}};
}

}  // namespace

Impedances rectangle_impedances(const HalfSpace& soil, const std::array<double, 2>& sides,
                                double embedment) {
  const bool turned = sides[1] > sides[0];
  const double length = std::max(sides[0], sides[1]) / 2;
  const double width = std::min(sides[0], sides[1]) / 2;
  const double ratio = length / width;
  const double area = 4 * length * width;
  const double modulus = soil.shear_modulus();
  const Six stiffness = static_stiffness(ratio, soil.poisson);
  const Six deeper = embedment_factors(ratio, embedment / width);
  const std::array<Softening, 6> soft = softenings(ratio);
  Impedances modes;
  for (std::size_t c = 0; c < modes.size(); ++c) {
    const double unit = modulus * width * (c < 3 ? 1 : width * width);
    const double spring = unit * stiffness[c] * deeper[c];
    // A share that falls below 0, as that about z of a very long mat, would be a stiffening.
    modes[c] =
        softening(spring, std::max(0.0, soft[c].share), soft[c].turn, width, soil.shear_velocity);
  }
  modes[0].dashpot = modes[1].dashpot = soil.density * soil.shear_velocity * area;
  constexpr double most = rectangle_safe_a0 * rectangle_safe_a0;
  modes[2].dashpot = std::max(0.0, soil.density * soil.longitudinal_velocity() * area -
                                       modes[2].inner_dashpot * most / (soft[2].turn + most));
  if (turned) {
    std::swap(modes[0], modes[1]);
    std::swap(modes[3], modes[4]);
  }
  return modes;
}

}  // namespace pounding
