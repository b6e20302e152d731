#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "common/matrix3.h"
#include "dense_model.h"
#include "elements/beam2.h"

namespace pounding {
namespace shear_beam_test {

using testing_support::dense_element;
using testing_support::DenseModel;
using testing_support::squared_circular_frequencies;

constexpr double pi = std::numbers::pi;

ElementProperties w24x76() {
  return {.young = 200e9,
          .poisson = 0.3,
          .density = 7850,
          .area = 144.5e-4,
          .inertia_y = 87410e-8,
          .inertia_z = 3434e-8,
          .torsion = 111.5e-8,
          .shear_area_y = 65e-4,
          .shear_area_z = 63e-4,
          .z_axis = {0.1, -0.2, 1}};
}

double shear_modulus(const ElementProperties& p) {
  return p.young / (2 * (1 + p.poisson));
}

/// `count` beams from the origin along `direction`, `length` m in all.
DenseModel line(const Vector3& direction, double length, std::size_t count,
                const ElementProperties& p, ElementType type = ElementType::beam) {
  std::vector<Vector3> nodes;
  for (std::size_t i = 0; i <= count; ++i) {
    const double x = length * static_cast<double>(i) / static_cast<double>(count);
    nodes.push_back({x * direction[0], x * direction[1], x * direction[2]});
  }
  DenseModel model(nodes, 6);
  for (std::size_t i = 0; i < count; ++i) model.add(type, {i, i + 1}, p);
  return model;
}

/// A cantilever of any length bends by P L^3 / (3 E I) + P L / (G A_s), by itself or in parts.
TEST(ShearBeam, CantileverTipMovesByShearAsWell) {
  const ElementProperties p = w24x76();
  const Vector3 x{2.0 / 7, 3.0 / 7, -6.0 / 7};
  const Vector3 y = normalised(cross(p.z_axis, x));
  const Vector3 z = cross(x, y);
  for (const double length : {0.3, 2.0, 12.0}) {
    for (const std::size_t count : {1U, 3U}) {
      DenseModel model = line(x, length, count, p);
      model.clamp(0);
      const std::size_t tip = model.size() - 6;
      const auto check = [&](const Vector3& across, const Vector3& about, double sign,
                             double inertia, double shear_area) {
        const double bent = length * length * length / (3 * p.young * inertia);
        const double sheared = length / (shear_modulus(p) * shear_area);
        std::vector<double> load(model.size(), 0.0);
        for (std::size_t d = 0; d < 3; ++d) load[tip + d] = across[d];
        const auto u = model.solve(load);
        for (std::size_t d = 0; d < 3; ++d) {
          EXPECT_NEAR(u[tip + d], (bent + sheared) * across[d], 1e-9 * (bent + sheared));
          EXPECT_NEAR(u[tip + 3 + d], sign * 1.5 * bent / length * about[d], 1e-9 * bent / length);
        }
      };
      check(y, z, +1, p.inertia_z, p.shear_area_y);
      check(z, y, -1, p.inertia_y, p.shear_area_z);
    }
  }
}

TEST(ShearBeam, WithoutShearAreasItIsAnEulerBeamButForItsRotaryInertia) {
  ElementProperties p = w24x76();
  p.shear_area_y = p.shear_area_z = 0;
  const std::vector<double> x{1, 2, 3, 1.5, 2.25, 3.75};
  const auto beam = dense_element(ElementType::beam, x, p);
  const auto euler = dense_element(ElementType::euler_beam, x, p);
  EXPECT_EQ(beam.stiffness, euler.stiffness);
  for (const std::size_t i : {0U, 1U, 2U}) EXPECT_EQ(beam.lumped_mass[i], euler.lumped_mass[i]);
  EXPECT_LT(beam.lumped_mass[4], euler.lumped_mass[4]);
}

TEST(ShearBeam, LumpedMassHasTheRotaryInertiaOfTheSectionAlone) {
  ElementProperties p = w24x76();
  p.z_axis = {0, 0, 1};
  p.added_mass = 70;
  const double half = 0.4;
  const auto mass = dense_element(ElementType::beam, {0, 0, 0, 2 * half, 0, 0}, p).lumped_mass;
  const double translation = half * (p.density * p.area + 70);
  const double expected[6] = {translation,
                              translation,
                              translation,
                              half * p.density * (p.inertia_y + p.inertia_z),
                              half * p.density * p.inertia_y,
                              half * p.density * p.inertia_z};
  for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(mass[i] / expected[i % 6], 1, 1e-14) << i;
}

/// Bending frequency of a free element: K_q (4 / (m L) + L^2 / (2 J)), see beam2.h.
double bending_frequency(double length, double inertia, double shear_area, double rotary,
                         const ElementProperties& p) {
  const double phi = 12 * p.young * inertia / (shear_modulus(p) * shear_area * length * length);
  const double stiffness = 12 * p.young * inertia / (length * length * length * (1 + phi));
  return std::sqrt(stiffness *
                   (4 / (p.density * p.area * length) + length * length / (2 * rotary)));
}

TEST(ShearBeam, LargestCircularFrequencyHasItsClosedForm) {
  ElementProperties p = w24x76();
  p.z_axis = {0, 0, 1};
  for (const double length : {0.076, 0.305, 1.52, 6.1}) {
    const auto e = dense_element(ElementType::beam, {0, 0, 0, length, 0, 0}, p);
    const auto values = squared_circular_frequencies(e.stiffness, e.lumped_mass);
    const double half = p.density * length / 2;
    const double expected =
        std::max({bending_frequency(length, p.inertia_y, p.shear_area_z, half * p.inertia_y, p),
                  bending_frequency(length, p.inertia_z, p.shear_area_y, half * p.inertia_z, p),
                  2 * std::sqrt(p.young / p.density) / length});
    EXPECT_NEAR(std::sqrt(values.back()) / expected, 1, 1e-12) << length;
  }
}

/// The table of published steps of a long beam; its shear areas are d t_w and 5/6 of the flanges.
TEST(ShearBeam, StableStepOfALongBeam) {
  ElementProperties p = w24x76();
  p.young = 2e11;
  p.z_axis = {0, 0, 1};
  const double inch = 0.0254;
  p.shear_area_z = 23.9 * 0.44 * inch * inch;
  p.shear_area_y = 5.0 / 6 * 2 * 8.99 * 0.68 * inch * inch;
  struct Row {
    double length, strong, weak;
  };
  for (const Row& row :
       {Row{3.05, 4.17e-4, 3.5e-4}, Row{1.52, 2.82e-4, 1.8e-4}, Row{0.61, 1.21e-4, 8.4e-5},
        Row{0.305, 6.04e-5, 5.7e-5}, Row{0.1525, 3.02e-5, 3.0e-5}, Row{0.076, 1.51e-5, 1.5e-5}}) {
    for (const bool strong : {true, false}) {
      DenseModel model = line({1, 0, 0}, 40 * row.length, 40, p);
      for (std::size_t n = 0; n <= 40; ++n) {
        for (const std::size_t c : {0U, 3U}) model.fix(n, c);
        for (const std::size_t c : {strong ? 1U : 2U, strong ? 5U : 4U}) model.fix(n, c);
      }
      const double step = 2 / (2 * pi * model.frequencies().back());
      EXPECT_NEAR(step / (strong ? row.strong : row.weak), 1, 0.02) << row.length << strong;
    }
  }
}

/// Frequencies of a pinned beam by Timoshenko, the lower root of
/// a w^4 - (1 + k^2 (r^2 + s^2)) w^2 + b k^4 = 0, at which a pinned lumped chain arrives by order 2.
TEST(ShearBeam, PinnedBeamConvergesToTimoshenkoAtSecondOrder) {
  ElementProperties p = w24x76();
  p.z_axis = {0, 0, 1};
  const double length = 3;
  const auto frequencies = [&](std::size_t count) {
    DenseModel model = line({1, 0, 0}, length, count, p);
    for (std::size_t n = 0; n <= count; ++n) {
      for (const std::size_t c : {0U, 1U, 3U, 5U}) model.fix(n, c);
    }
    model.fix(0, 2);
    model.fix(count, 2);
    return model.frequencies();
  };
  const auto coarse = frequencies(16);
  const auto fine = frequencies(32);
  for (std::size_t j = 1; j <= 4; ++j) {
    const double k = static_cast<double>(j) * pi / length;
    const double rotary = p.inertia_y / p.area;
    const double shear = p.young * p.inertia_y / (shear_modulus(p) * p.shear_area_z);
    const double a = rotary * shear * p.density * p.area / (p.young * p.inertia_y);
    const double b = 1 + k * k * (rotary + shear);
    const double c = std::pow(k, 4) * p.young * p.inertia_y / (p.density * p.area);
    const double exact = std::sqrt(2 * c / (b + std::sqrt(b * b - 4 * a * c))) / (2 * pi);
    EXPECT_NEAR(fine[j - 1] / exact, 1, 0.01) << j;
    EXPECT_NEAR(std::log2((coarse[j - 1] - exact) / (fine[j - 1] - exact)), 2, 0.1) << j;
  }
}

double rotary_inertia(double length, double frequency, ElementProperties p) {
  p.resolved_frequency = 2 * pi * frequency;
  p.z_axis = {0, 0, 1};
  return dense_element(ElementType::beam, {0, 0, 0, length, 0, 0}, p).lumped_mass[5];
}

/// D <= .001 (M + K / w^2), as a matrix.
TEST(ShearBeam, AddedRotaryInertiaIsAThousandthOfWhatMovesAtMost) {
  const ElementProperties p = w24x76();
  int bounded = 0;
  for (const double frequency : {5.0, 30.0, 100.0, 400.0}) {
    for (const double length : {0.05, 0.3, 1.0, 3.0, 6.0, 20.0}) {
      const double own = p.density * length / 2 * p.inertia_z;
      const double added = rotary_inertia(length, frequency, p) - own;
      EXPECT_GE(added, -1e-12 * own);
      if (added < 1e-9 * own) continue;
      // In the plane of the weak axis: u_1, r_1, u_2, r_2.
      ElementProperties level = p;
      level.z_axis = {0, 0, 1};
      const auto e = dense_element(ElementType::beam, {0, 0, 0, length, 0, 0}, level);
      const std::size_t dofs[] = {1, 5, 7, 11};
      const double w2 = std::pow(2 * pi * frequency, 2);
      double largest = 0;
      // x^T D x over x^T (M + K / w^2) x, by the Schur complement of u for r = (1, 1), (1, -1)
      for (const double sign : {1.0, -1.0}) {
        const auto k = [&](std::size_t i, std::size_t j) {
          return e.stiffness[dofs[i] * 12 + dofs[j]] / w2;
        };
        const double m = e.lumped_mass[1];
        const double rr = 2 * own + k(1, 1) + k(3, 3) + 2 * sign * k(1, 3);
        const double ur = k(0, 1) + sign * k(0, 3);  // u_1 = -u_2 takes part with r = (1, 1) only
        const double uu = m + k(0, 0) - k(0, 2);     // per node
        const double left = sign > 0 ? rr - 2 * ur * ur / uu : rr;
        largest = std::max(largest, 2 * added / left);
      }
      EXPECT_LT(largest, 0.001 * (1 + 1e-9)) << frequency << ' ' << length;
      if (largest > 0.001 * (1 - 1e-9)) ++bounded;
    }
  }
  EXPECT_GT(bounded, 3);
}

TEST(ShearBeam, AddedRotaryInertiaLetsSlenderBeamsKeepUpWithTheirStretch) {
  const ElementProperties p = w24x76();
  const double stretch = 2 * std::sqrt(p.young / p.density);
  const auto bending = [&](double length, double frequency) {
    return bending_frequency(length, p.inertia_z, p.shear_area_y,
                             rotary_inertia(length, frequency, p), p) *
           length / stretch;
  };
  EXPECT_NEAR(bending(6.1, 5), 1, 1e-9) << "enough of it";
  const double none = bending(6.1, 1e9);
  EXPECT_GT(none, 1.7) << "where every frequency counts";
  EXPECT_LT(bending(6.1, 15), 0.9 * none) << "some of it";
  EXPECT_GT(bending(6.1, 15), 1.05);
  const double own = p.density * 0.15 / 2 * p.inertia_z;
  EXPECT_NEAR(rotary_inertia(0.15, 400, p), own, 1e-12 * own) << "a short beam needs none";
}

/// Modes up to the frequency fall, and by no more than .1 %.
TEST(ShearBeam, ModesThatCountFallByAThousandthAtMost) {
  ElementProperties p = w24x76();
  p.z_axis = {0, 0, 1};
  const double highest = 60;
  const auto frequencies = [&](double resolved) {
    p.resolved_frequency = 2 * pi * resolved;
    DenseModel model = line({1, 0, 0}, 24.4, 8, p);
    model.clamp(0);
    return model.frequencies();
  };
  const auto without = frequencies(0);
  const auto with = frequencies(highest);
  int seen = 0;
  for (std::size_t i = 0; i < with.size() && without[i] < highest; ++i) {
    EXPECT_LE(with[i], without[i] * (1 + 1e-9)) << i;
    EXPECT_GE(with[i], without[i] * (1 - 1e-3)) << i;
    ++seen;
  }
  EXPECT_GT(seen, 5);
  EXPECT_LT(with.back(), 0.99 * without.back());
}

}  // namespace shear_beam_test
}  // namespace pounding
