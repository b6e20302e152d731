#include "soil/disk.h"

#include <cmath>
#include <numbers>

namespace pounding {
namespace {

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
