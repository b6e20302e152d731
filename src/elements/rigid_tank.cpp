#include "elements/rigid_tank.h"

#include <cmath>
#include <numbers>

namespace pounding {
namespace {

using std::numbers::pi;

/// Sums over n odd of 1 / n^3 and of 1 / n^4.
constexpr double sum_of_cubes = 1.0517997902646450;  // 7 zeta(3) / 8
constexpr double sum_of_fourths = pi * pi * pi * pi / 96;

/// Terms of modes beyond it are below round-off.
constexpr double largest_exponent = 40;

WaterMass sloshing_mode(int n, double depth, double length, double gravity) {
  const double a = n * pi * depth / length;
  WaterMass mode;
  mode.mass = 8 * std::tanh(a) / (std::pow(n * pi, 3) * depth / length);
  mode.height = 1 - std::tanh(a / 2) / a;
  mode.height_with_floor = mode.height + 1 / (a * std::sinh(a));
  mode.circular_frequency = std::sqrt(n * pi * gravity / length * std::tanh(a));
  mode.wave = 4 * std::tanh(a) / (n * pi);
  return mode;
}

/// Joins the masses of two parts at the height of their resultant.
void join(double sign, const WaterMass& part, WaterMass& all) {
  const double mass = all.mass + sign * part.mass;
  all.height = (all.mass * all.height + sign * part.mass * part.height) / mass;
  all.height_with_floor =
      (all.mass * all.height_with_floor + sign * part.mass * part.height_with_floor) / mass;
  all.mass = mass;
}

/// All convective modes together.
WaterMass all_modes(double depth, double length) {
  const double slenderness = depth / length;
  double cubes = sum_of_cubes;
  double fourths = sum_of_fourths;
  double floor = 0;
  for (int n = 1; n * pi * slenderness < largest_exponent; n += 2) {
    const double a = n * pi * slenderness;
    cubes -= (1 - std::tanh(a)) / std::pow(n, 3);
    fourths -= (1 - std::tanh(a) * std::tanh(a / 2)) / std::pow(n, 4);
    floor += 1 / (std::pow(n, 4) * std::cosh(a));
  }
  const double of_mass = 8 / (std::pow(pi, 3) * slenderness);
  const double of_moment = of_mass / (pi * slenderness);
  WaterMass all;
  all.mass = of_mass * cubes;
  all.height = 1 - of_moment * fourths / all.mass;
  all.height_with_floor = all.height + of_moment * floor / all.mass;
  return all;
}

}  // namespace

TankWater water_in_tank(double depth, double length, double gravity, int modes) {
  const double over_floor = 0.5 + length * length / (12 * depth * depth);
  TankWater water;
  WaterMass rest = all_modes(depth, length);
  water.impulsive = {1, 0.5, over_floor};
  join(-1, rest, water.impulsive);
  for (int n = 1; n < 2 * modes; n += 2) {
    water.convective.push_back(sloshing_mode(n, depth, length, gravity));
    join(-1, water.convective.back(), rest);
  }
  join(1, rest, water.convective.back());
  return water;
}

double impulsive_pressure(double height, double depth, double length) {
  constexpr int terms = 200;
  double sum = 0;
  for (int k = 0; k < terms; ++k) {
    const double a = (k + 0.5) * pi;
    sum += (k % 2 == 0 ? 2 : -2) / (a * a) * std::tanh(a * length / (2 * depth)) *
           std::cos(a * height);
  }
  return sum;
}

}  // namespace pounding
