#include "solvers/law_solver.h"

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "laws/dashpot_law.h"
#include "laws/tension_law.h"
#include "laws/yield_law.h"

namespace pounding::interactions {
namespace law_solver_test {

constexpr double time_step = 1e-3;

/// Rows with random coefficients over some dofs of random mass, b of each.
struct Rows {
  std::vector<std::unique_ptr<LinkLaw>> laws;
  std::vector<std::vector<double>> coefficients;
  std::vector<double> inverse_mass;
  Elongations elongations{0};

  Rows(std::size_t rows, std::size_t dofs, std::mt19937& random) : elongations(rows) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (std::size_t i = 0; i < dofs; ++i) inverse_mass.push_back(1e-3 * (1.5 + uniform(random)));
    for (std::size_t r = 0; r < rows; ++r) {
      std::vector<double>& row = coefficients.emplace_back(dofs);
      for (double& value : row) value = uniform(random);
      elongations.before[r] = 1e-3 * uniform(random);
      elongations.now[r] = elongations.before[r] + 1e-4 * uniform(random);
      elongations.free_after[r] = elongations.now[r] + 1e-4 * uniform(random);
    }
  }

  double compliance(std::size_t a, std::size_t b) const {
    double sum = 0;
    for (std::size_t i = 0; i < inverse_mass.size(); ++i) {
      sum += coefficients[a][i] * inverse_mass[i] * coefficients[b][i];
    }
    return sum;
  }

  LawSolver solver() const {
    std::vector<std::vector<Coupling>> couplings(laws.size());
    for (std::size_t a = 0; a < laws.size(); ++a) {
      couplings[a].push_back({a, compliance(a, a)});
      for (std::size_t b = 0; b < laws.size(); ++b) {
        if (b != a) couplings[a].push_back({b, compliance(a, b)});
      }
    }
    return {laws, std::move(couplings), {}, time_step};
  }

  /// Largest difference of a force and the force of its law at the elongation that all of them
  /// leave [N].
  double defect(double share, const LawMemory& memory, const std::vector<double>& force) const {
    double largest = 0;
    for (std::size_t a = 0; a < laws.size(); ++a) {
      double after = elongations.free_after[a];
      for (std::size_t b = 0; b < laws.size(); ++b) {
        after -= share * time_step * time_step * compliance(a, b) * force[b];
      }
      const double by_law =
          laws[a]->force(elongations.before[a], elongations.now[a], after, memory[a]);
      largest = std::max(largest, std::abs(by_law - force[a]));
    }
    return largest;
  }
};

double largest_of(const std::vector<double>& force) {
  double largest = 0;
  for (const double value : force) largest = std::max(largest, std::abs(value));
  return largest;
}

/// Every third of nine coupled rows follows such a law, the others are dashpots.
template <typename Law>
void expect_laws_beside_dashpots(const Law& law) {
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round) {
    Rows rows(9, 6, random);
    for (std::size_t r = 0; r < 9; ++r) {
      if (r % 3 == 0) {
        rows.laws.push_back(std::make_unique<Law>(law));
      } else {
        rows.laws.push_back(std::make_unique<DashpotLaw>(3e8));
        rows.elongations.free_after[r] -= rows.elongations.now[r];
        rows.elongations.before[r] -= rows.elongations.now[r];
        rows.elongations.now[r] = 0;
      }
    }
    LawSolver solver = rows.solver();
    LawMemory memory(rows.laws);
    for (std::size_t r = 0; r < 9; ++r) {
      rows.laws[r]->yield(rows.elongations.now[r], 0.5, memory[r]);
    }
    const std::vector<double> driven(9, 0.0);
    for (const double share : {0.5, 1.0}) {
      std::vector<double> force(9, 0.0);
      solver.solve(share, rows.elongations, driven, memory, force);
      EXPECT_GT(largest_of(force), 0);
      EXPECT_LT(rows.defect(share, memory, force), 1e-10 * largest_of(force)) << round;
    }
  }
}

TEST(LawSolver, FulfilsEveryLawOfCoupledDashpotsAndBars) {
  expect_laws_beside_dashpots(TensionLaw(2e7, 0));
}

TEST(LawSolver, FulfilsEveryLawOfCoupledDashpotsAndExplicitLaws) {
  const YieldLaw law(2e7, 0.1, 1e3);
  EXPECT_TRUE(law.is_explicit());
  expect_laws_beside_dashpots(law);
}

TEST(LawSolver, TakesTheKnownForceOfFillersThatDoNotLetGo) {
  std::mt19937 random(11);
  const Filler foam{{{0.1, 1e5}, {0.5, 2e5}}, 1e7};
  int held = 0;
  for (int round = 0; round < 40; ++round) {
    Rows rows(5, 12, random);
    for (std::size_t r = 0; r < 5; ++r) {
      rows.laws.push_back(std::make_unique<FillerLaw>(foam, 0.05, 0.2));
    }
    LawMemory memory(rows.laws);
    for (std::size_t r = 0; r < 5; ++r) {
      rows.laws[r]->yield(rows.elongations.now[r], 1, memory[r]);
    }
    LawSolver solver = rows.solver();
    std::vector<double> force(5, 0.0);
    solver.solve(1, rows.elongations, std::vector<double>(5, 0.0), memory, force);
    EXPECT_LE(rows.defect(1, memory, force), 1e-10 * largest_of(force)) << round;
    bool all = largest_of(force) > 0;
    for (std::size_t r = 0; r < 5; ++r) {
      all = all && force[r] == rows.laws[r]->full(rows.elongations.now[r], memory[r]);
    }
    held += all ? 1 : 0;
  }
  EXPECT_GT(held, 0);
  EXPECT_LT(held, 40);
}

TEST(LawSolver, RowsOnOneBodyMoveEachOtherByItsMotions) {
  std::mt19937 random(3);
  constexpr std::size_t count = 20;  // so many are solved for by the motions of the body
  Rows rows(count, 6, random);
  for (double& value : rows.inverse_mass) value = 1;  // motions are those of unit mass
  std::vector<OnBody> on_body;
  std::vector<std::vector<Coupling>> couplings(count);
  for (std::size_t r = 0; r < count; ++r) {
    rows.laws.push_back(std::make_unique<DashpotLaw>(1e4));
    rows.elongations.now[r] = 0;
    OnBody& body = on_body.emplace_back(OnBody{0, {}});
    for (std::size_t m = 0; m < 6; ++m) body.motion[m] = rows.coefficients[r][m];
    couplings[r].push_back({r, rows.compliance(r, r)});
  }
  LawSolver solver(rows.laws, couplings, on_body, time_step);
  const LawMemory memory(rows.laws);
  std::vector<double> force(count, 0.0);
  solver.solve(1, rows.elongations, std::vector<double>(count, 0.0), memory, force);
  EXPECT_LT(rows.defect(1, memory, force), 1e-10 * largest_of(force));
}

TEST(LawSolver, IsIdleWhereNothingPulls) {
  std::mt19937 random(5);
  Rows rows(2, 3, random);
  for (int r = 0; r < 2; ++r) rows.laws.push_back(std::make_unique<TensionLaw>(1e6, 0));
  const LawSolver solver = rows.solver();
  const LawMemory memory(rows.laws);
  EXPECT_TRUE(solver.is_idle(std::vector<double>{-1e-3, 0}, memory));
  EXPECT_FALSE(solver.is_idle(std::vector<double>{-1e-3, 1e-6}, memory));
}

}  // namespace law_solver_test
}  // namespace pounding::interactions
