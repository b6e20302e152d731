#include <cmath>
#include <complex>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "laws/dashpot_law.h"
#include "support/passive_oscillator.h"

namespace pounding::interactions {
namespace soil_law_test {

constexpr double dt = 1e-3;

/// Numbers from far below to far above those that go with the step.
std::vector<Impedance> impedances() {
  std::vector<Impedance> list;
  for (const double c : {0.0, 3.0, 1e9}) {
    for (const double c1 : {1e-6, 40.0, 1e10}) {
      for (const double m : {1e-9, 0.7, 1e12}) {
        for (const double m3 : {0.0, 2.0, 1e8}) list.push_back({100, c, c1, m, m3});
      }
    }
    for (const double m3 : {0.0, 2.0, 1e8}) list.push_back({100, c + 1, 0, 0, m3});
    for (const double k1 : {1e-5, 300.0, 1e11}) {
      for (const double m : {0.0, 1e-9, 0.7, 1e12}) {
        for (const double c1 : {1e-6, 40.0, 1e10}) list.push_back({100, c, c1, m, 2, k1});
      }
    }
  }
  return list;
}

/// For any elongations at all the work is no less than the change of the energy, and what is lost
/// is d (c r^2 + F^2 / c1).
TEST(SoilLaw, LosesNeverLessThanNothing) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const Impedance& impedance : impedances()) {
    const SoilLaw law(impedance, dt);
    std::vector<double> memory(law.memory_size(), 0.0);
    double before = any(random);
    double now = any(random);
    for (int n = 0; n < 200; ++n) {
      const double after = any(random);
      const double force = law.force(before, now, after, memory);
      const double held = law.energy(before, now, memory);
      const std::vector<double> kept = memory;
      law.remember(before, now, after, 1, memory);
      const double work = force * (after - before) / 2;
      const double change = law.energy(now, after, memory) - held;
      const double mean = (after - before) / (2 * dt);
      double lost = impedance.dashpot * mean * mean;
      if (impedance.inner_dashpot > 0) {
        // Of a spring in series the rate of the dashpot is small beside those of which it is left.
        const double inner = impedance.inner_stiffness > 0
                                 ? (kept.back() + memory.back()) / 2
                                 : impedance.inner_dashpot * (mean - (kept[0] + memory[0]) / 2);
        lost += inner * inner / impedance.inner_dashpot;
      }
      const double size = std::abs(work) + held + std::abs(change);
      EXPECT_NEAR(work - change, dt * lost, 1e-11 * size);
      EXPECT_GE(work - change, -1e-11 * size);
      EXPECT_GE(held, 0);
      before = now;
      now = after;
    }
  }
}

TEST(SoilLaw, SolutionIsTheForceOfTheElongationThatItLeaves) {
  for (const Impedance& impedance : impedances()) {
    const SoilLaw law(impedance, dt);
    std::vector<double> memory(law.memory_size(), 0.4);
    for (const double compliance : {0.0, 1e-9, 1e-3, 10.0}) {
      const double force = law.solve(-0.2, 0.1, 0.7, compliance, memory);
      const double after = 0.7 - compliance * force;
      const double size = law.rate() * (1 + compliance * std::abs(force)) + std::abs(force) +
                          std::abs(law.offset(-0.2, 0.1, 1, memory));
      EXPECT_NEAR(law.force(-0.2, 0.1, after, memory), force, 1e-14 * size);
    }
  }
}

/// A force that knows only differences, as links need that are counted from e_n.
TEST(SoilLaw, DoesNotKnowWhereTheMatIs) {
  const SoilLaw law({0, 5, 7, 0.3, 0.2}, dt);
  const std::vector<double> memory{0.25};
  EXPECT_DOUBLE_EQ(law.force(-1, 0, 2, memory), law.force(7, 8, 10, memory));
}

/// Force over a harmonic motion, once the internal mass has come to its own.
void expect_impedance_to_second_order(const Impedance& impedance) {
  std::vector<double> errors;
  for (const double step : {2e-3, 1e-3}) {
    const double omega = 30;
    const SoilLaw law(impedance, step);
    std::vector<double> memory(law.memory_size(), 0.0);
    std::complex<double> sum = 0;
    const double turn = 2 * std::acos(-1.0) / omega;
    const int period = static_cast<int>(std::lround(turn / step));
    const double exact_omega = 2 * std::acos(-1.0) / (period * step);
    const auto e = [&](int n) { return std::sin(exact_omega * n * step); };
    for (int n = 1; n <= 20 * period; ++n) {
      const double force = law.force(e(n - 1), e(n), e(n + 1), memory);
      law.remember(e(n - 1), e(n), e(n + 1), 1, memory);
      if (n > 19 * period) {
        sum += force * std::exp(std::complex<double>(0, -exact_omega * n * step));
      }
    }
    const std::complex<double> found = std::complex<double>(0, 2) * sum / double(period);
    const std::complex<double> exact = impedance.at(exact_omega);
    errors.push_back(std::abs(found - exact) / std::abs(exact));
  }
  EXPECT_LT(errors[1], 1e-3);
  EXPECT_NEAR(errors[0] / errors[1], 4, 0.2);
}

TEST(SoilLaw, HasTheImpedanceToSecondOrder) {
  expect_impedance_to_second_order({0, 5, 7, 0.3, 0.2});
  expect_impedance_to_second_order({0, 5, 7, 0.3, 0.2, 90});
  expect_impedance_to_second_order({0, 5, 7, 0, 0.2, 90});
}

/// Explicit steps of a mass on a spring at 0.999 of its limit with a soil of any numbers: the energy
/// of both never grows.
TEST(SoilLaw, DoesNotMoveTheStableStep) {
  for (const Impedance& impedance : impedances()) {
    const SoilLaw law(impedance, dt);
    const std::vector<double> start(law.memory_size(), 0.0);
    expect_energy_never_grows(law, start, dt, 20000);
  }
}

}  // namespace soil_law_test
}  // namespace pounding::interactions
