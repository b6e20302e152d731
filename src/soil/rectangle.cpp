#include "soil/rectangle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
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

/// Rotational cone: spring, and an internal mass at the end of a dashpot rho c I.
Impedance rotational_cone(double stiffness, double density, double velocity, double inertia,
                          double apex) {
  Impedance mode;
  mode.stiffness = stiffness;
  mode.inner_dashpot = density * velocity * inertia;
  mode.inner_mass = density * inertia * apex;
  return mode;
}

/// Springs, and dashpots and masses of the cones.
Impedances cones(const HalfSpace& soil, double radius) {
  using std::numbers::pi;
  const double nu = soil.poisson;
  const double modulus = soil.shear_modulus();
  const double area = pi * radius * radius;
  const double inertia = area * radius * radius / 4;
  const bool nearly_incompressible = nu > 1.0 / 3;
  const double shear = soil.shear_velocity;
  const double velocity =
      nearly_incompressible ? 2 * shear : shear * std::sqrt(2 * (1 - nu) / (1 - 2 * nu));
  const double cube = modulus * radius * radius * radius;
  Impedances modes;
  modes[0].stiffness = 8 * modulus * radius / (2 - nu);
  modes[0].dashpot = soil.density * shear * area;
  modes[1] = modes[0];
  modes[2].stiffness = 4 * modulus * radius / (1 - nu);
  modes[2].dashpot = soil.density * velocity * area;
  const double apex = 9 * pi / 32 * radius;
  const double steeper = (1 - nu) * velocity * velocity / (shear * shear);
  modes[3] =
      rotational_cone(8 * cube / (3 * (1 - nu)), soil.density, velocity, inertia, apex * steeper);
  if (nearly_incompressible) {
    modes[2].mass = 2.4 * (nu - 1.0 / 3) * soil.density * area * radius;
    modes[3].mass = 1.2 * (nu - 1.0 / 3) * soil.density * inertia * radius;
  }
  modes[4] = modes[3];
  modes[5] = rotational_cone(16 * cube / 3, soil.density, shear, 2 * inertia, apex);
  return modes;
}

/// K (1 - b1 x / (1 + x)) + i omega (c4 + K b1 b2 t x / (1 + x)), x = (b2 a0)^2, t = R / V_s.
Impedance veletsos_verbic(double stiffness, double b1, double b2, double to_ground, double time) {
  Impedance mode = softening(stiffness, b1, 1 / (b2 * b2), time, 1);
  mode.dashpot = stiffness * to_ground * time;
  return mode;
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

Impedances disk_impedances(const HalfSpace& soil, double radius) {
  Impedances modes = cones(soil, radius);
  constexpr double tabulated = 1.0 / 3;
  constexpr double near = 5.4e-3;  // 0.328 to 0.338: "0.33" is meant
  if (std::abs(soil.poisson - tabulated) > near) return modes;
  const double time = radius / soil.shear_velocity;
  modes[0] = modes[1] = {modes[0].stiffness, 0.65 * modes[0].stiffness * time, 0, 0, 0};
  modes[2] = veletsos_verbic(modes[2].stiffness, 0.35, 0.8, 0.75, time);
  modes[3] = modes[4] = veletsos_verbic(modes[3].stiffness, 0.8, 0.5, 0, time);
  return modes;
}

}  // namespace pounding
