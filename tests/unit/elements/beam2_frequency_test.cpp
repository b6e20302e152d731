#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "dense_model.h"

namespace pounding {
namespace beam2_frequency_test {

using testing_support::DenseModel;

constexpr double pi = std::numbers::pi;

/// Square section of side `a`, bending in the global x-y plane.
ElementProperties square_steel(double a, double density = 7800) {
  ElementProperties p;
  p.young = 200e9;
  p.poisson = 0.3;
  p.density = density;
  p.area = a * a;
  p.inertia_y = p.inertia_z = a * a * a * a / 12;
  p.torsion = 0.1406 * a * a * a * a;
  p.z_axis = {0, 0, 1};
  return p;
}

/// A straight beam along x that moves in the x-y plane only.
DenseModel plane_beam(std::size_t count, double length, const ElementProperties& properties) {
  std::vector<Vector3> nodes;
  for (std::size_t i = 0; i <= count; ++i)
    nodes.push_back({length * static_cast<double>(i) / static_cast<double>(count), 0, 0});
  DenseModel model(nodes, 6);
  for (std::size_t i = 0; i < count; ++i)
    model.add(ElementType::euler_beam, {i, i + 1}, properties);
  for (std::size_t i = 0; i <= count; ++i)
    for (const std::size_t c : {2U, 3U, 4U}) model.fix(i, c);
  return model;
}

/// Frequency of the wave sin(kx) in an endless chain of elements of length h, whose nodes carry
/// rho A h and 2 gamma rho A h^3: det([24 (1 - cos kh) - m, -12 sin kh; -12 sin kh,
/// 8 + 4 cos kh - 2 gamma m]) = 0, m = omega^2 rho A h^4 / E I. Pinned ends fit such a wave.
double chain_frequency(double k, double h, const ElementProperties& p) {
  const double gamma = 1.0 / 24 + p.inertia_z / (2 * p.area * h * h);
  const double stiff_w = 24 * (1 - std::cos(k * h));
  const double stiff_r = 8 + 4 * std::cos(k * h);
  const double coupling = 12 * std::sin(k * h);
  const double a = 2 * gamma;
  const double b = -(stiff_r + 2 * gamma * stiff_w);
  const double c = stiff_w * stiff_r - coupling * coupling;
  const double m = 2 * c / (-b + std::sqrt(b * b - 4 * a * c));  // the smaller root
  const double h4 = h * h * h * h;
  return std::sqrt(m * p.young * p.inertia_z / (p.density * p.area * h4)) / (2 * pi);
}

DenseModel pinned_beam(std::size_t count, double length, const ElementProperties& properties) {
  DenseModel model = plane_beam(count, length, properties);
  for (std::size_t i = 0; i <= count; ++i) model.fix(i, 0);
  model.fix(0, 1);
  model.fix(count, 1);
  return model;
}

TEST(Beam2Frequency, PinnedBeamFollowsTheLumpedDispersion) {
  const ElementProperties p = square_steel(0.4);
  const auto f = pinned_beam(10, 5.0, p).frequencies();
  for (std::size_t j = 1; j <= 6; ++j) {
    const double exact = chain_frequency(static_cast<double>(j) * pi / 5, 0.5, p);
    EXPECT_NEAR(f[j - 1] / exact, 1, 1e-10) << j;
  }
}

TEST(Beam2Frequency, DeepPinnedBeamConvergesToRayleighAtSecondOrder) {
  // The rotary inertia rho I L / 2 of the nodes is that of Rayleigh's beam:
  // omega^2 = k^4 E I / (rho A (1 + k^2 I / A)).
  const ElementProperties p = square_steel(2, 8000);
  const double table[] = {44.61700278317053, 170.50761831130922, 358.4713872189189};
  const double radius2 = p.inertia_z / p.area;
  const auto coarse = pinned_beam(16, 10, p).frequencies();
  const auto fine = pinned_beam(32, 10, p).frequencies();
  for (std::size_t j = 0; j < 3; ++j) {
    const double k = static_cast<double>(j + 1) * pi / 10;
    const double exact =
        k * k * std::sqrt(p.young * radius2 / (p.density * (1 + k * k * radius2))) / (2 * pi);
    EXPECT_NEAR(exact / table[j], 1, 1e-12);
    const double order = std::log2((coarse[j] - exact) / (fine[j] - exact));
    EXPECT_NEAR(order, 2, 0.05) << j;
    EXPECT_LT(fine[j], exact) << "lumped mass comes from below";
  }
}

TEST(Beam2Frequency, SlenderCantileverHasTheTabulatedLumpedErrors) {
  // gamma = 1/24: the section is so thin that its own rotary inertia does not count.
  const double beta_length[] = {1.8751040687119611, 4.694091132974175, 7.854757438237613,
                                10.995540734875467};
  struct Row {
    std::size_t count;
    double error[4];
  };
  const Row rows[] = {{4, {-0.0389, -0.145, -0.23, -0.307}},
                      {8, {-0.0101, -0.0433, -0.0805, -0.122}},
                      {16, {-0.00254, -0.0113, -0.0221, -0.0357}}};
  const ElementProperties p = square_steel(1e-3);
  for (const Row& row : rows) {
    DenseModel model = plane_beam(row.count, 3, p);
    model.clamp(0);
    const auto f = model.frequencies();
    for (std::size_t j = 0; j < 4; ++j) {
      const double k = beta_length[j] / 3;
      const double exact =
          k * k * std::sqrt(p.young * p.inertia_z / (p.density * p.area)) / (2 * pi);
      EXPECT_NEAR((f[j] / exact - 1) / row.error[j], 1, 5e-3) << row.count << ' ' << j;
    }
  }
}

/// Portal frame in the x-y plane, height 3, span 4, `count` elements per member.
DenseModel portal(std::size_t count, bool clamped) {
  ElementProperties column = square_steel(1), beam = square_steel(1);
  column.area = 5.38e-3;
  column.inertia_y = column.inertia_z = 1.673e-5;
  beam.area = 2.85e-3;
  beam.inertia_y = beam.inertia_z = 1.943e-5;
  std::vector<Vector3> nodes;
  const double n = static_cast<double>(count);
  for (std::size_t i = 0; i <= count; ++i) nodes.push_back({0, 3 * static_cast<double>(i) / n, 0});
  for (std::size_t i = 1; i <= count; ++i) nodes.push_back({4 * static_cast<double>(i) / n, 3, 0});
  for (std::size_t i = 1; i <= count; ++i)
    nodes.push_back({4, 3 - 3 * static_cast<double>(i) / n, 0});
  DenseModel model(nodes, 6);
  for (std::size_t i = 0; i < 3 * count; ++i) {
    const bool is_beam = i >= count && i < 2 * count;
    model.add(ElementType::euler_beam, {i, i + 1}, is_beam ? beam : column);
  }
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const std::size_t c : {2U, 3U, 4U}) model.fix(i, c);
  for (const std::size_t foot : {std::size_t{0}, nodes.size() - 1}) {
    model.fix(foot, 0);
    model.fix(foot, 1);
    if (clamped) model.fix(foot, 5);
  }
  return model;
}

TEST(Beam2Frequency, PortalStiffnessWithTheTablesOwnMasses) {
  // The table lumps rho A L^3 / 78 (HRZ): give the nodes that rotary inertia and keep the rest.
  const double fixed[] = {17.2741, 55.7016, 100.0477, 102.8379, 188.7747, 250.3001};
  const double pinned[] = {7.7571, 45.481, 73.3477, 81.7058, 174.8791, 206.7339};
  for (const bool clamped : {true, false}) {
    const std::size_t count = 4;
    DenseModel model = portal(count, clamped);
    const double column = 7800 * 5.38e-3 * std::pow(0.75, 3) / 78;
    const double beam = 7800 * 2.85e-3 / 78;
    for (std::size_t node = 0; node < model.nodes().size(); ++node) {
      double inertia = 0;
      for (const std::size_t element : {node - 1, node})
        if (element < 3 * count) inertia += element >= count && element < 2 * count ? beam : column;
      model.lumped_mass()[model.dof(node, 5)] = inertia;
    }
    const auto f = model.frequencies();
    for (std::size_t j = 0; j < 6; ++j)
      EXPECT_NEAR(f[j], clamped ? fixed[j] : pinned[j], 1e-4) << clamped << ' ' << j;
  }
}

TEST(Beam2Frequency, PortalFirstFrequencyWithOurMasses) {
  // Exact Euler-Bernoulli 17.378 and 7.783496 Hz; the sections' rotary inertia takes off 0.04 %.
  EXPECT_NEAR(portal(16, true).frequencies()[0] / 17.378, 1, 1.2e-3);
  EXPECT_NEAR(portal(16, false).frequencies()[0] / 7.783496, 1, 1.2e-3);
  EXPECT_LT(portal(16, true).frequencies()[0], 17.378);
}

}  // namespace beam2_frequency_test
}  // namespace pounding
