#include "modal/modal_basis.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "common/dense_matrix.h"
#include "common/error.h"
#include "modal/modal_analysis.h"
#include "modal/reduced_system.h"
#include "modal/shifted_solver.h"
#include "reduced_box.h"
#include "support/refusal.h"

namespace pounding {
namespace modal_basis_test {

using testing_support::ReducedBox;

/// Phi f(omega^2) Phi^T at two points.
template <typename Function>
double between(const ModalBasis& basis, std::size_t a, std::size_t b, Function&& function) {
  double sum = 0;
  for (std::size_t i = 0; i < basis.size(); ++i) {
    sum += basis.rows[a * basis.size() + i] * function(basis.squared_frequency[i]) *
           basis.rows[b * basis.size() + i];
  }
  return sum;
}

/// Column of K^-1 of a unit force at a point.
std::vector<double> static_response(const ReducedBox& box, const TracePoint& point) {
  const ShiftedSolver solver(box.system.stiffness->matrix(), 0);
  std::vector<double> response(box.system.lumped_mass.size(), 0.0);
  response[box.dof(point)] = 1;
  solver.solve(response);
  return response;
}

/// Number of eigenvalues of H over the contact points that are not round-off, H = T M^-1 T^T.
std::size_t rank_of_delassus(const ModalBasis& basis, std::size_t points) {
  DenseMatrix h(points, points);
  for (std::size_t a = 0; a < points; ++a) {
    for (std::size_t b = 0; b < points; ++b) {
      h.column(a)[b] = between(basis, a, b, [](double) { return 1.0; });
    }
  }
  const std::vector<double> values = symmetric_eigenvalues(h);
  return static_cast<std::size_t>(std::count_if(
      values.begin(), values.end(), [&](double value) { return value > 1e-10 * values.back(); }));
}

TEST(ModalBasis, OfAllModesIsTheModelItself) {
  ReducedBox box(true);
  const ModalBasis basis = box.basis(100000);
  EXPECT_EQ(static_cast<GlobalIndex>(basis.size()), box.system.global_dofs);
  EXPECT_EQ(basis.modes, static_cast<int>(basis.size()));
  EXPECT_EQ(basis.attachment_vectors, 0);
  EXPECT_EQ(basis.points.size(), 13u);  // that of the clamped node is not there
  EXPECT_DOUBLE_EQ(basis.total_mass, box.system.total_mass);
  const auto mass = [](double) { return 1.0; };
  for (std::size_t a = 0; a < basis.points.size(); ++a) {
    for (std::size_t b = 0; b < basis.points.size(); ++b) {
      const double inverse_mass = box.system.inverse_mass[box.dof(basis.points[a])];
      EXPECT_NEAR(between(basis, a, b, mass), a == b ? inverse_mass : 0, 1e-12 * inverse_mass);
    }
  }
  for (std::size_t d = 0; d < 3; ++d) {  // sum of the effective masses
    double sum = 0;
    for (std::size_t i = 0; i < basis.size(); ++i) {
      sum += std::pow(basis.participation[d * basis.size() + i], 2);
    }
    EXPECT_NEAR(sum, basis.mass, 1e-10 * basis.mass);
  }
}

TEST(ModalBasis, ChoosesTheModesThatContactFeels) {
  ReducedBox box(true);
  box.request.other_points = {};
  const ModalBasis all = box.basis(24, false);
  const ModalBasis chosen = box.basis(8, false, 24);
  ASSERT_EQ(chosen.size(), 8u);
  EXPECT_EQ(chosen.modes, 8);
  std::vector<double> share(24, 0.0);
  for (std::size_t p = 0; p < all.points.size(); ++p) {
    double sum = 0;
    for (std::size_t k = 0; k < 24; ++k) {
      sum += std::pow(all.rows[p * 24 + k], 2);
    }
    for (std::size_t k = 0; k < 24; ++k) {
      share[k] += std::pow(all.rows[p * 24 + k], 2) / sum / all.squared_frequency[k];
    }
  }
  std::vector<std::size_t> order(18);
  std::iota(order.begin(), order.end(), std::size_t{6});
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return share[a] > share[b]; });
  std::vector<std::size_t> expected{0, 1, 2, 3, 4, 5, order[0], order[1]};
  std::ranges::sort(expected);
  EXPECT_NE(expected[7], 7u);  // not just the lowest
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(chosen.squared_frequency[i] / all.squared_frequency[expected[i]], 1, 1e-9) << i;
  }
  // Attachment vectors still find the whole flexibility.
  const ModalBasis attached = box.basis(8, true, 24);
  const std::vector<double> response = static_response(box, attached.points[0]);
  for (std::size_t p = 0; p < box.request.contact_points.size(); ++p) {
    EXPECT_NEAR(between(attached, 0, p, [](double square) { return 1 / square; }),
                response[box.dof(attached.points[p])],
                1e-9 * response[box.dof(attached.points[0])]);
  }
}

TEST(ModalBasis, KnowsWhichOfItsVectorsAreModes) {
  ReducedBox box(true);
  box.request.other_points = {};
  const ModalBasis all = box.basis(24, false);
  const ModalBasis mixed = box.basis(8, true, 24);
  ASSERT_EQ(mixed.mode_numbers.size(), mixed.size());
  std::vector<std::size_t> places;  // of the modes
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    if (mixed.mode_numbers[i] > 0) {
      places.push_back(i);
      const auto mode = static_cast<std::size_t>(mixed.mode_numbers[i] - 1);
      EXPECT_NEAR(mixed.squared_frequency[i] / all.squared_frequency[mode], 1, 1e-9) << i;
    }
  }
  ASSERT_EQ(places.size(), 8u);
  EXPECT_GT(places.back(), 7u);  // vectors that are no modes stand between them
  const ModalResult modes = modes_of_basis(mixed, 8);
  ASSERT_EQ(modes.modes.size(), 8u);
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_NEAR(modes.modes[k].frequency * 2 * std::numbers::pi,
                std::sqrt(mixed.squared_frequency[places[k]]), 1e-9);
  }
}

TEST(ModalBasis, HoldsTheLowestModes) {
  ReducedBox box(true);
  const ModalResult modes = lowest_modes(box.system, box.mesh, 6);
  const ModalBasis basis = box.basis(6);
  EXPECT_EQ(basis.modes, 6);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(std::sqrt(basis.squared_frequency[i]) / (2 * std::numbers::pi),
                modes.modes[i].frequency, 1e-8 * modes.modes[i].frequency);
  }
}

/// What attachment vectors are for: forces at the contact points find the whole flexibility.
TEST(ModalBasis, HasTheStaticFlexibilityOfTheContactPoints) {
  ReducedBox box(true);
  const ModalBasis with = box.basis(3);
  const ModalBasis without = box.basis(3, false);
  EXPECT_EQ(with.attachment_vectors, 12);
  EXPECT_EQ(without.attachment_vectors, 0);
  const auto flexibility = [](double square) { return 1 / square; };
  double missing = 0;
  for (std::size_t a = 0; a < 12; ++a) {
    const std::vector<double> response = static_response(box, box.request.contact_points[a]);
    const double own = response[box.dof(box.request.contact_points[a])];
    for (std::size_t b = 0; b < 12; ++b) {
      const double expected = response[box.dof(box.request.contact_points[b])];
      EXPECT_NEAR(between(with, a, b, flexibility), expected, 1e-8 * own);
    }
    missing = std::max(missing, 1 - between(without, a, a, flexibility) / own);
  }
  EXPECT_GT(missing, 0.1);
}

TEST(ModalBasis, KeepsTheRankOfTheDelassusOperator) {
  ReducedBox box(true);
  const ModalBasis with = box.basis(3);
  const ModalBasis without = box.basis(3, false);
  EXPECT_EQ(rank_of_delassus(with, 12), 12u);
  EXPECT_EQ(rank_of_delassus(without, 12), 3u);
  for (std::size_t a = 0; a < 12; ++a) {
    const double full = box.system.inverse_mass[box.dof(box.request.contact_points[a])];
    const double reduced = between(with, a, a, [](double) { return 1.0; });
    EXPECT_LE(reduced, full * (1 + 1e-12));  // a basis cannot move more than everything
    EXPECT_GE(reduced, 0.4 * full);
  }
}

TEST(ModalBasis, OfAFreeBodyHasItsRigidMotions) {
  ReducedBox box(false);
  const ModalBasis basis = box.basis(8);
  EXPECT_EQ(basis.attachment_vectors, 12);
  const double elastic = basis.squared_frequency[6];
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_LE(basis.squared_frequency[i], 1e-8 * elastic);
  }
  double sum = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    sum += std::pow(basis.participation[i], 2);
  }
  EXPECT_NEAR(sum, basis.mass, 1e-8 * basis.mass);
  EXPECT_EQ(rank_of_delassus(basis, 12), 12u);
}

TEST(ModalBasis, HoldsEveryModeBelowTheCutOff) {
  ReducedBox box(true);
  const ModalResult modes = lowest_modes(box.system, box.mesh, 12);
  box.request.cutoff = (modes.modes[8].frequency + modes.modes[9].frequency) / 2;
  EXPECT_EQ(box.basis(0).modes, 9);
  box.request.cutoff = modes.modes[0].frequency / 2;
  EXPECT_NE(testing_support::refusal_of([&] { box.basis(0); }).find("-box_modal_cutoff"),
            std::string::npos);
}

}  // namespace modal_basis_test
}  // namespace pounding
