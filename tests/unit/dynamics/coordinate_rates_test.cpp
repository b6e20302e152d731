#include <cmath>

#include <gtest/gtest.h>

#include "dynamics/unilateral_contact.h"
#include "stiffness/stiffness.h"

namespace pounding {
namespace coordinate_rates_test {

constexpr double time_step = 1e-3;
constexpr double peak = 5;  // m/s2
const std::vector<double> stiffness{0, 400, 1e5, 1.8e3 * 1.8e3};

/// Four coordinates, from one that has no stiffness to one close to the limit of the step.
LinearSystem four_coordinates() {
  LinearSystem system;
  system.damping = {0.4, 2e-5};
  system.lumped_mass = {1, 1, 2.5, 1};
  system.inverse_mass = {1, 1, 0.4, 1};
  system.total_mass = 100;
  system.generalised = std::make_unique<GeneralisedCoordinates>();
  system.generalised->influence = {{{3, -2, 0.5, 0.1}, {0, 0, 0, 0}, {0, 0, 0, 0}}};
  system.stiffness = std::make_unique<stiffness::DiagonalStiffness>(MPI_COMM_SELF, stiffness);
  return system;
}

/// The same four with uniform damping in place of Rayleigh's; the fastest a little slower, so that
/// it stays below its limit.
LinearSystem filtered_coordinates() {
  LinearSystem system = four_coordinates();
  system.damping = {};
  system.uniform_damping = fit_uniform_damping(0.1, 1, 100, 3);
  system.uniform_damping->reference = 2;
  system.lumped_mass[3] = 2;
  system.inverse_mass[3] = 0.5;
  return system;
}

const std::vector<double> rows{0.1,  -0.4, 0.2, 0.3,  //
                               -0.2, 0.1,  0.6, -0.1};

/// The scheme of dynamics/cd_lagrange.h, coordinate by coordinate.
class Motion {
 public:
  explicit Motion(const LinearSystem& system) : system_(system) {
    state.displacement = {0, 0.03, 1e-3, 2e-4};
    state.velocity = {0.5, 0, -0.2, 0.1};
    if (system.uniform_damping) state.filtered.assign(3, std::vector<double>(4, 0.0));
  }
  void step(double ground_acceleration) {
    for (std::size_t i = 0; i < 4; ++i) {
      double& v = state.velocity[i];
      double force = stiffness[i] * (state.displacement[i] + system_.damping.beta * v);
      if (system_.uniform_damping) force = filtered_force(i);
      v += time_step * (-system_.inverse_mass[i] * force - system_.damping.alpha * v -
                        system_.generalised->influence[0][i] * ground_acceleration);
      state.displacement[i] += time_step * v;
    }
  }
  double largest_rate() const {
    double largest = 0;
    for (std::size_t r = 0; r < rows.size() / 4; ++r) {
      double rate = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        rate += rows[4 * r + i] * state.velocity[i];
      }
      largest = std::max(largest, std::abs(rate));
    }
    return largest;
  }
  StructureState state;

 private:
  double filtered_force(std::size_t i) {
    const UniformDamping& damping = *system_.uniform_damping;
    const double q = stiffness[i] * state.displacement[i];
    double force = q;
    for (std::size_t k = 0; k < 3; ++k) {
      double& memory = state.filtered[k][i];
      const double c = damping.filters[k].rate * time_step / 2;
      const double w = memory + c / (1 + c) * q;
      memory = ((1 - c) * w + c * q) / (1 + c);
      force += damping.filters[k].weight * (q - w);
    }
    return damping.at_rest() * force;
  }

  const LinearSystem& system_;
};

/// Shaken as hard as it may be, now in one direction, now in the other.
double shaking(int step) {
  return std::sin(0.37 * step) > 0 ? peak : -peak;
}

void expect_bound(const LinearSystem& system) {
  CoordinateRates rates(system, rows, peak, time_step);
  Motion motion(system);
  for (int start = 0; start < 40; ++start) {
    motion.step(shaking(start));
    const double rate = rates.rate(motion.state);
    Motion later = motion;
    double closest = 0;
    for (int n = 1; n < 400; ++n) {
      // Along with the first coordinate's own motion: the worst that the ground can do to it.
      later.step(later.state.velocity[0] > 0 ? -peak : peak);
      ASSERT_LE(later.largest_rate(), rate + n * rates.growth()) << start << ' ' << n;
      closest = std::max(closest, later.largest_rate() / (rate + n * rates.growth()));
    }
    EXPECT_GT(closest, 0.3);  // a bound, but not one that is worth nothing
  }
}

TEST(CoordinateRates, NoGapMovesFaster) {
  expect_bound(four_coordinates());
}

TEST(CoordinateRates, NoGapMovesFasterWithUniformDamping) {
  expect_bound(filtered_coordinates());
}

TEST(CoordinateRates, AtRestNothingMoves) {
  const LinearSystem system = four_coordinates();
  CoordinateRates rates(system, rows, 0, time_step);
  StructureState rest;
  rest.displacement.assign(4, 0.0);
  rest.velocity.assign(4, 0.0);
  EXPECT_EQ(rates.rate(rest), 0);
  EXPECT_EQ(rates.growth(), 0);
}

TEST(CoordinateRates, LetTheWatchWaitWithoutEnergies) {
  std::vector<LinearSystem> systems;
  systems.push_back(four_coordinates());
  CoordinateRates rates(systems[0], rows, peak, time_step);
  GapWatch watch(systems, {{1e3, {}, rows}}, {peak, 0, 0}, time_step);
  Motion motion(systems[0]);
  motion.step(peak);
  ASSERT_TRUE(watch.measures());
  watch.measure({&motion.state, 1});
  const double clearance = 0.05;
  watch.looked(1, clearance, false);
  std::int64_t next = 2;
  while (!watch.due(next)) {
    ++next;
  }
  const auto moved = [&](double steps) {
    return time_step * steps * (rates.rate(motion.state) + rates.growth() * (steps + 2));
  };
  EXPECT_LT(moved(static_cast<double>(next - 1)), clearance);
  EXPECT_GE(moved(static_cast<double>(next)), clearance);
  EXPECT_GT(next, 5);
  EXPECT_FALSE(watch.needs_look(next - 1));  // a record falls there: the bound stays in force
  EXPECT_TRUE(watch.needs_look(next));
  watch.looked(next, clearance, true);  // what contact does to the motion is known afterwards
  EXPECT_TRUE(watch.due(next + 1));
  watch.looked(next + 1, clearance, false);
  EXPECT_FALSE(watch.due(next + 2));
}

}  // namespace coordinate_rates_test
}  // namespace pounding
