#include "modal/reduced_system.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "common/error.h"
#include "reduced_box.h"
#include "system/trace.h"

namespace pounding {
namespace reduced_system_test {

using testing_support::ReducedBox;

/// Some numbers in no order.
std::vector<double> values(std::size_t count) {
  std::vector<double> result(count);
  for (std::size_t i = 0; i < count; ++i) {
    result[i] = std::sin(12.9898 * static_cast<double>(i) + 1);
  }
  return result;
}

class ReducedSystem : public ::testing::Test {
 protected:
  ReducedSystem() {
    box.structure.modal = ModalModel{};
    box.structure.modal->modes = 7;
    box.structure.damping = {0.3, 2e-6};
    box.structure.gravity = {0, 0, -9.81};
    basis = box.basis(7);
    rows = basis.rows;
  }
  LinearSystem build() {
    return build_reduced_system(MPI_COMM_SELF, 0, box.structure, box.mesh, basis);
  }

  ReducedBox box{true};
  ModalBasis basis;
  std::vector<double> rows;
};

TEST_F(ReducedSystem, IsInTheCoordinatesOfTheBasis) {
  const LinearSystem system = build();
  const std::size_t size = basis.size();
  EXPECT_EQ(system.global_dofs, static_cast<GlobalIndex>(size));
  EXPECT_EQ(system.owned_dofs(), static_cast<LocalIndex>(size));
  EXPECT_EQ(system.lumped_mass, std::vector<double>(size, 1.0));
  EXPECT_DOUBLE_EQ(system.total_mass, box.system.total_mass);
  EXPECT_EQ(system.gravity, box.structure.gravity);
  EXPECT_EQ(system.damping.alpha, 0.3);
  EXPECT_EQ(system.damping.beta, 2e-6);
  EXPECT_FALSE(system.has_extra_damping());
  for (int d = 0; d < 3; ++d) {
    const auto begin = basis.participation.begin() + static_cast<std::ptrdiff_t>(size) * d;
    EXPECT_EQ(system.influence(d),
              std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(size)));
  }
  std::vector<double> w = values(size);
  std::vector<double> q(size);
  const VecHandle argument = wrap_vector(system, w);
  const VecHandle force = wrap_vector(system, q);
  system.stiffness->apply(argument.get(), force.get());
  for (std::size_t i = 0; i < size; ++i) {
    EXPECT_DOUBLE_EQ(q[i], basis.squared_frequency[i] * w[i]);
  }
}

TEST_F(ReducedSystem, TraceIsTheRowsOfTheBasis) {
  const LinearSystem system = build();
  std::vector<TracePoint> places = box.request.contact_points;
  places.push_back(box.request.other_points[1]);  // clamped
  places.push_back(box.request.other_points[0]);
  Trace trace(system, box.mesh, places, true);
  const std::size_t size = basis.size();
  ASSERT_EQ(trace.known().size(), places.size());
  ASSERT_EQ(trace.dofs().size(), size);
  const std::vector<double> q = values(size);
  std::vector<double> u(2 * places.size(), 7.0);
  trace.apply(q.data(), u.data(), 2);
  std::vector<double> f(places.size());
  for (std::size_t p = 0; p < places.size(); ++p) {
    const std::size_t row = p < 12 ? p : 12;
    const double expected =
        p == 12 ? 0 : std::inner_product(q.begin(), q.end(), rows.begin() + row * size, 0.0);
    EXPECT_NEAR(u[2 * p], expected, 1e-14);
    EXPECT_EQ(u[2 * p + 1], 7.0);
    f[p] = 1 + static_cast<double>(p);
  }
  // Velocities that impulses cause, seen at the places, are the compliance times the impulses.
  std::vector<double> velocity(size, 0.0);
  trace.add_impulse(f.data(), velocity.data());
  trace.apply(velocity.data(), u.data(), 1);
  for (std::size_t a = 0; a < places.size(); ++a) {
    double expected = 0;
    for (std::size_t b = 0; b < places.size(); ++b) {
      expected += trace.compliance(a, b) * f[b];
    }
    EXPECT_NEAR(u[a], expected, 1e-14 * places.size());
  }
}

TEST_F(ReducedSystem, RefusesAPlaceThatTheBasisWasNotMadeFor) {
  const LinearSystem system = build();
  const std::vector<TracePoint> places{{box.request.contact_points[3].node, 2}};
  EXPECT_THROW(Trace(system, box.mesh, places, true), std::logic_error);
}

TEST_F(ReducedSystem, LimitIsThatOfTheWorstCoordinate) {
  EXPECT_DOUBLE_EQ(largest_frequency(box.structure, basis).omega_max,
                   std::sqrt(basis.squared_frequency.back()));
  const double dt = stable_time_step(box.structure, basis);
  EXPECT_NEAR(energy_margin(box.structure, basis, dt), 0, 1e-12);
  EXPECT_GT(energy_margin(box.structure, basis, 0.9 * dt), 0);
  // Undamped but for the first mode, which then holds the limit: dt -> 1 / (xi omega).
  box.structure.modal->damping_ratios = {0.999, 0};
  const double first = std::sqrt(basis.squared_frequency.front());
  EXPECT_DOUBLE_EQ(stable_time_step(box.structure, basis),
                   std::min(2 / largest_frequency(box.structure, basis).omega_max,
                            2 / (first * (0.999 + std::sqrt(1 + 0.999 * 0.999)))));
}

TEST_F(ReducedSystem, ScaledMassMovesTheLimitToTheStepAskedFor) {
  const double limit = stable_time_step(box.structure, basis);
  for (const bool ratios : {false, true}) {
    if (ratios) {
      box.structure.modal->damping_ratios = {0.02, 0.3};
    }
    for (const double factor : {0.9, 3.0}) {
      box.structure.mass_scaling = 0;
      const double plain = stable_time_step(box.structure, basis);
      box.structure.mass_scaling = factor * limit;
      EXPECT_NEAR(stable_time_step(box.structure, basis) / std::max(plain, factor * limit), 1,
                  1e-12);
      const std::vector<double> masses = coordinate_masses(box.structure, basis);
      EXPECT_EQ(masses.front(), 1);
      EXPECT_EQ(masses.back() > 1, plain < factor * limit);
    }
  }
  box.structure.mass_scaling = 3 * limit;
  box.structure.modal->damping_ratios.clear();
  const std::vector<double> masses = coordinate_masses(box.structure, basis);
  ModalBasis kept = basis;
  const LinearSystem system = build_reduced_system(MPI_COMM_SELF, 0, box.structure, box.mesh, kept);
  EXPECT_EQ(system.lumped_mass, masses);
  for (std::size_t i = 0; i < masses.size(); ++i) {
    // The load of the ground, M_q iota, is what it was.
    EXPECT_NEAR(masses[i] * system.influence(2)[i], basis.participation[2 * basis.size() + i],
                1e-14 * std::sqrt(basis.total_mass));
  }
  box.structure.mass_scaling = 2 / box.structure.damping.alpha;
  EXPECT_THROW(coordinate_masses(box.structure, basis), UserError);
}

TEST_F(ReducedSystem, DampingRatiosAreADiagonalMatrix) {
  box.structure.modal->damping_ratios = {0.01, 0.02};
  const LinearSystem system = build();
  EXPECT_EQ(system.damping.alpha, 0);
  EXPECT_EQ(system.damping.beta, 0);
  ASSERT_TRUE(system.extra_damping);
  std::vector<double> one(basis.size(), 1.0);
  std::vector<double> rate(basis.size());
  const VecHandle argument = wrap_vector(system, one);
  const VecHandle product = wrap_vector(system, rate);
  system.extra_damping->apply(argument.get(), product.get());
  for (std::size_t i = 0; i < rate.size(); ++i) {
    EXPECT_DOUBLE_EQ(rate[i], 2 * (i == 0 ? 0.01 : 0.02) * std::sqrt(basis.squared_frequency[i]));
  }
}

TEST_F(ReducedSystem, DampingRatiosGoByTheNumberOfTheMode) {
  basis = box.basis(8, true, 24);
  std::vector<double>& ratios = box.structure.modal->damping_ratios;
  for (int mode = 1; mode <= 24; ++mode) {
    ratios.push_back(0.001 * mode);
  }
  ratios.push_back(0.5);
  const std::vector<double> squares = basis.squared_frequency;
  const std::vector<int> numbers = basis.mode_numbers;
  const LinearSystem system = build();
  std::vector<double> one(squares.size(), 1.0);
  std::vector<double> rate(squares.size());
  const VecHandle argument = wrap_vector(system, one);
  const VecHandle product = wrap_vector(system, rate);
  system.extra_damping->apply(argument.get(), product.get());
  bool apart = false;  // a coordinate is not the mode of its own place
  for (std::size_t i = 0; i < rate.size(); ++i) {
    const double ratio = numbers[i] > 0 ? 0.001 * numbers[i] : 0.5;
    EXPECT_DOUBLE_EQ(rate[i], 2 * ratio * std::sqrt(squares[i])) << i;
    apart = apart || (numbers[i] > 0 && numbers[i] != static_cast<int>(i) + 1);
  }
  EXPECT_TRUE(apart);
}

TEST_F(ReducedSystem, NamesTheCoordinateThatMovesMost) {
  const LinearSystem system = build();
  std::vector<double> motion(basis.size(), 0.1);
  motion[4] = -3;
  EXPECT_EQ(locate_largest(system, basis, motion), describe_coordinate(basis, 4));
  EXPECT_EQ(describe_coordinate(basis, 4).substr(0, 26), "generalised coordinate 5 (");
  motion[2] = std::nan("");
  EXPECT_EQ(locate_largest(system, basis, motion), describe_coordinate(basis, 2));
}

}  // namespace reduced_system_test
}  // namespace pounding
