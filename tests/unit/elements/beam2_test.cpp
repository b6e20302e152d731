#include "elements/beam2.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/matrix3.h"
#include "dense_model.h"
#include "elements/element_traits.h"

namespace pounding {
namespace beam2_test {

using testing_support::dense_element;
using testing_support::DenseModel;
using testing_support::squared_circular_frequencies;

ElementProperties hea160(const Vector3& z_axis) {
  return {.young = 200e9,
          .poisson = 0.3,
          .density = 7800,
          .area = 38.77e-4,
          .inertia_y = 1673e-8,
          .inertia_z = 615.6e-8,
          .torsion = 12.19e-8,
          .z_axis = z_axis};
}

Vector3 scaled(const Vector3& v, double factor) {
  return {v[0] * factor, v[1] * factor, v[2] * factor};
}

/// The local axes, built here on their own: Gram-Schmidt on z_axis.
struct Axes {
  Vector3 x, y, z;
};

Axes axes_of(const Vector3& along, const Vector3& z_axis) {
  Axes axes;
  axes.x = scaled(along, 1 / norm(along));
  const double part = dot(z_axis, axes.x);
  for (std::size_t i = 0; i < 3; ++i) axes.z[i] = z_axis[i] - part * axes.x[i];
  axes.z = scaled(axes.z, 1 / norm(axes.z));
  axes.y = cross(axes.z, axes.x);
  return axes;
}

struct Direction {
  Vector3 along;
  Vector3 z_axis;
};

const Direction directions[] = {{{2, 0, 0}, {0, 0, 1}},       {{0, 0, 2}, {1, 0, 0}},
                                {{0, 0, -3}, {0, 5, 1}},      {{1, 2, -0.5}, {0.3, 0.1, 1}},
                                {{-1, 0.4, 2}, {0, 1e-3, 0}}, {{0.01, -3, 0.2}, {7, 1, 2}}};

/// A cantilever of `count` elements from the origin to `along`.
DenseModel cantilever(const Direction& direction, std::size_t count) {
  std::vector<Vector3> nodes;
  for (std::size_t i = 0; i <= count; ++i)
    nodes.push_back(scaled(direction.along, static_cast<double>(i) / static_cast<double>(count)));
  DenseModel model(nodes, 6);
  for (std::size_t i = 0; i < count; ++i)
    model.add(ElementType::euler_beam, {i, i + 1}, hea160(direction.z_axis));
  model.clamp(0);
  return model;
}

/// Motion of the tip under a force and a moment on it.
struct Tip {
  Vector3 displacement;
  Vector3 rotation;
};

Tip loaded_tip(const DenseModel& model, const Vector3& force, const Vector3& moment) {
  const std::size_t first = model.size() - 6;
  std::vector<double> load(model.size(), 0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    load[first + i] = force[i];
    load[first + 3 + i] = moment[i];
  }
  const auto u = model.solve(load);
  return {{u[first], u[first + 1], u[first + 2]}, {u[first + 3], u[first + 4], u[first + 5]}};
}

void expect_near(const Vector3& found, const Vector3& expected, double scale) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], 1e-9 * scale);
}

TEST(Beam2, CantileverTipFollowsBeamTheoryInAnyDirection) {
  for (const Direction& direction : directions) {
    const Axes axes = axes_of(direction.along, direction.z_axis);
    const ElementProperties p = hea160(direction.z_axis);
    const double length = norm(direction.along);
    const double shear = p.young / (2 * (1 + p.poisson));
    const double force = 1e3, moment = 1e2;
    for (const std::size_t count : {1U, 3U}) {
      const DenseModel model = cantilever(direction, count);
      // Bending in the local x-z plane (inertia_y): w = P L^3 / 3 E I, r_y = -P L^2 / 2 E I.
      const double wz = force * std::pow(length, 3) / (3 * p.young * p.inertia_y);
      Tip tip = loaded_tip(model, scaled(axes.z, force), {});
      expect_near(tip.displacement, scaled(axes.z, wz), wz);
      expect_near(tip.rotation, scaled(axes.y, -1.5 * wz / length), wz / length);
      // In the local x-y plane (inertia_z).
      const double wy = force * std::pow(length, 3) / (3 * p.young * p.inertia_z);
      tip = loaded_tip(model, scaled(axes.y, force), {});
      expect_near(tip.displacement, scaled(axes.y, wy), wy);
      expect_near(tip.rotation, scaled(axes.z, 1.5 * wy / length), wy / length);
      // Torsion T L / G J and extension P L / E A.
      const double twist = moment * length / (shear * p.torsion);
      tip = loaded_tip(model, {}, scaled(axes.x, moment));
      expect_near(tip.displacement, {}, twist * length);
      expect_near(tip.rotation, scaled(axes.x, twist), twist);
      const double stretch = force * length / (p.young * p.area);
      tip = loaded_tip(model, scaled(axes.x, force), {});
      expect_near(tip.displacement, scaled(axes.x, stretch), stretch);
      // End moment about local y: r_y = M L / E I, w = -M L^2 / 2 E I.
      const double slope = moment * length / (p.young * p.inertia_y);
      tip = loaded_tip(model, {}, scaled(axes.y, moment));
      expect_near(tip.rotation, scaled(axes.y, slope), slope);
      expect_near(tip.displacement, scaled(axes.z, -slope * length / 2), slope * length);
    }
  }
}

TEST(Beam2, LumpedMassAlongTheAxes) {
  const double length = 0.8;
  const ElementProperties p = hea160({0, 0, 1});
  const auto mass = dense_element(ElementType::euler_beam, {0, 0, 0, length, 0, 0}, p).lumped_mass;
  const double chord = p.density * p.area * std::pow(length, 3) / 24;
  const double half = p.density * length / 2;
  const double expected[6] = {half * p.area,
                              half * p.area,
                              half * p.area,
                              half * (p.inertia_y + p.inertia_z),
                              chord + half * p.inertia_y,
                              chord + half * p.inertia_z};
  for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(mass[i] / expected[i % 6], 1, 1e-14) << i;
}

TEST(Beam2, WhatItCarriesTurnsWithItsLength) {
  const double length = 0.8;
  ElementProperties p = hea160({0, 0, 1});
  const auto bare = dense_element(ElementType::euler_beam, {0, 0, 0, length, 0, 0}, p).lumped_mass;
  p.added_mass = 70;
  const auto loaded =
      dense_element(ElementType::euler_beam, {0, 0, 0, length, 0, 0}, p).lumped_mass;
  const double chord = 70 * std::pow(length, 3) / 24;
  const double more[6] = {35 * length, 35 * length, 35 * length, 0, chord, chord};
  for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(loaded[i] - bare[i], more[i % 6], 1e-12) << i;
}

TEST(Beam2, LumpedMassOfAColumnAndOfADiagonal) {
  // A column whose local z is global x: local y is global y, local x global z.
  const double length = 0.8;
  ElementProperties p = hea160({1, 0, 0});
  const double chord = p.density * p.area * std::pow(length, 3) / 24;
  const double half = p.density * length / 2;
  const auto column =
      dense_element(ElementType::euler_beam, {0, 0, 0, 0, 0, length}, p).lumped_mass;
  EXPECT_NEAR(column[3] / (chord + half * p.inertia_z), 1, 1e-14);
  EXPECT_NEAR(column[4] / (chord + half * p.inertia_y), 1, 1e-14);
  EXPECT_NEAR(column[5] / (half * (p.inertia_y + p.inertia_z)), 1, 1e-14);
  // Along y with local z on global x: the axes go round, local (x, y, z) = global (y, z, x).
  const auto level = dense_element(ElementType::euler_beam, {0, 0, 0, 0, length, 0}, p).lumped_mass;
  EXPECT_NEAR(level[3] / (chord + half * p.inertia_z), 1, 1e-14);
  EXPECT_NEAR(level[4] / (half * (p.inertia_y + p.inertia_z)), 1, 1e-14);
  EXPECT_NEAR(level[5] / (chord + half * p.inertia_y), 1, 1e-14);
  // At 45 degrees in x-y: the diagonal of R diag R' is the mean of the two local inertias.
  p.z_axis = {0, 0, 1};
  const double leg = length / std::sqrt(2.0);
  const auto slanted =
      dense_element(ElementType::euler_beam, {0, 0, 0, leg, leg, 0}, p).lumped_mass;
  const double mean = (half * (p.inertia_y + p.inertia_z) + chord + half * p.inertia_y) / 2;
  EXPECT_NEAR(slanted[3] / mean, 1, 1e-14);
  EXPECT_NEAR(slanted[4] / mean, 1, 1e-14);
  EXPECT_NEAR(slanted[5] / (chord + half * p.inertia_z), 1, 1e-14);
  // The trace is kept in any direction.
  p.z_axis = {0.3, 0.1, 1};
  const auto oblique =
      dense_element(ElementType::euler_beam,
                    {1, 1, 1, 1 + length * 2 / 7, 1 + length * 3 / 7, 1 - length * 6 / 7}, p)
          .lumped_mass;
  EXPECT_NEAR((oblique[3] + oblique[4] + oblique[5]) / (column[3] + column[4] + column[5]), 1,
              1e-14);
}

TEST(Beam2, LargestCircularFrequencyHasItsClosedForm) {
  // Bending of a free element: sqrt(48 + 6 / gamma) sqrt(E I / rho A) / L^2, gamma rho A L^3 being
  // the rotary inertia of a node: here 1/24 + I / (2 A L^2). Stretch: 2 sqrt(E / rho) / L.
  for (const double length : {0.12, 0.25, 1.0, 5.0}) {
    const ElementProperties p = hea160({0, 0, 1});
    const auto e = dense_element(ElementType::euler_beam, {0, 0, 0, length, 0, 0}, p);
    const auto bending = [&](double inertia) {
      const double gamma = 1.0 / 24 + inertia / (2 * p.area * length * length);
      return std::sqrt((48 + 6 / gamma) * p.young * inertia / (p.density * p.area)) /
             (length * length);
    };
    const double stretch = 2 * std::sqrt(p.young / p.density) / length;
    const double expected = std::max({bending(p.inertia_y), bending(p.inertia_z), stretch});
    const auto values = squared_circular_frequencies(e.stiffness, e.lumped_mass);
    EXPECT_NEAR(std::sqrt(values.back()) / expected, 1, 1e-12) << length;
    // Every closed form is in the spectrum.
    for (const double omega : {bending(p.inertia_y), bending(p.inertia_z), stretch}) {
      double nearest = std::numeric_limits<double>::max();
      for (const double value : values)
        nearest = std::min(nearest, std::abs(value / (omega * omega) - 1));
      EXPECT_LT(nearest, 1e-11) << length;
    }
  }
}

TEST(Beam2, SlenderElementReachesTheTabulatedFrequency) {
  // gamma -> 1/24 when the section is thin: 13.8564065 sqrt(E I / rho A) / L^2.
  ElementProperties p = hea160({0, 0, 1});
  p.area = 1e-2;
  p.inertia_y = p.inertia_z = p.torsion = 1e-10;
  const auto e = dense_element(ElementType::euler_beam, {0, 0, 0, 1, 0, 0}, p);
  const double unit = std::sqrt(p.young * p.inertia_y / (p.density * p.area));
  const auto values = squared_circular_frequencies(e.stiffness, e.lumped_mass);
  double nearest = 1e300;
  for (const double value : values)
    nearest = std::min(nearest, std::abs(std::sqrt(std::max(value, 0.0)) / unit - 13.8564065));
  EXPECT_LT(nearest, 1e-6);
}

void expect_refused(const std::vector<double>& x, const Vector3& z_axis, const char* word) {
  std::vector<double> mass(12);
  for (const bool mass_alone : {false, true}) {
    try {
      if (mass_alone)
        element_lumped_mass(ElementType::euler_beam, x, hea160(z_axis), mass);
      else
        dense_element(ElementType::euler_beam, x, hea160(z_axis));
      ADD_FAILURE() << "accepted, expected: " << word;
    } catch (const ElementError& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
}

TEST(Beam2, ImpossibleBeamsAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refused({1, 2, 3, 1, 2, 3}, {0, 0, 1}, "zero length");
  expect_refused({1e6, 0, 0, 1e6, 1e-7, 0}, {0, 0, 1}, "zero length");
  expect_refused({0, 0, 0, nan, 0, 0}, {0, 0, 1}, "zero length");
  expect_refused({0, 0, 0, 0, 0, 2}, {0, 0, 1}, "parallel");
  expect_refused({0, 0, 0, 0, 0, 2}, {0, 0, -1e-3}, "parallel");
  expect_refused({0, 0, 0, 1, 2, 3}, {1, 2, 3.000001}, "parallel");
  expect_refused({0, 0, 0, 1, 0, 0}, {0, 0, 0}, "not a direction");
  expect_refused({0, 0, 0, 1, 0, 0}, {0, 0, nan}, "not a direction");
  EXPECT_NO_THROW(dense_element(ElementType::euler_beam, {0, 0, 0, 0, 0, 2}, hea160({1e-5, 0, 1})));
}

}  // namespace beam2_test
}  // namespace pounding
