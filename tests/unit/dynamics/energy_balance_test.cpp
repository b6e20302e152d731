#include "dynamics/energy_balance.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace pounding {
namespace energy_balance_test {

/// The largest residual of the run over the largest term, both of any line.
TEST(EnergyBalance, RemembersTheLargestResidualAndTheLargestTerm) {
  const std::vector<LinearSystem> none;
  EnergyBalance balance(MPI_COMM_SELF, none, 1e-3);
  EnergyLine line;
  line.kinetic = 20;
  line.strain = 5;
  line.residual = -4;
  balance.note(line);
  EXPECT_DOUBLE_EQ(balance.relative_residual(), 4.0 / 20);
  line.rows[ledger_row("contact_work")] = -50;
  line.residual = 1;
  balance.note(line);
  EXPECT_DOUBLE_EQ(balance.relative_residual(), 4.0 / 50);
  EXPECT_DOUBLE_EQ(balance.largest_term(), 50);
}

constexpr double dt = 0.05;

/// Two masses of 1 kg with stiffness-proportional damping, `skew` the part of K that is not
/// symmetric, stepped as cd_lagrange.h says, with what the dashpots take summed up beside.
class TwoMasses {
 public:
  explicit TwoMasses(double skew) : k_{{{50, skew - 20}, {-skew - 20, 30}}} {
    LinearSystem& system = systems_.emplace_back();
    system.lumped_mass = system.inverse_mass = {1, 1};
    system.damping = {0, 0.01};
  }
  std::array<double, 2> product(const std::array<double, 2>& x) const {
    return {k_[0][0] * x[0] + k_[0][1] * x[1], k_[1][0] * x[0] + k_[1][1] * x[1]};
  }
  /// Steps until the ledger has closed `count` of them; its line.
  EnergyLine line_after(int count) {
    EnergyBalance balance(MPI_COMM_SELF, systems_, dt);
    for (int n = 0; n < count + 2; ++n) {
      const double h = n == 0 ? dt / 2 : dt;
      const auto now = product(u_), rate = product(v_);
      StepSums sums;
      double taken = 0;
      for (std::size_t i = 0; i < 2; ++i) {
        const double q = now[i] + beta() * rate[i];
        const double after = v_[i] - h * q, before = u_[i] - dt * v_[i];
        sums.kinetic_before += v_[i] * v_[i];
        sums.stiffness_before += v_[i] * rate[i];
        sums.strain_before += u_[i] * (now[i] - dt * rate[i]);
        sums.strain_back += before * now[i];
        sums.stiffness_work += q * (after + v_[i]);
        sums.mass_sum += (after + v_[i]) * (after + v_[i]);
        mean_[i] = (after + v_[i]) / 2;
        v_[i] = after;
      }
      for (std::size_t i = 0; i < 2; ++i) taken += mean_[i] * product(mean_)[i];
      balance.add_step({&sums, 1}, {});
      if (n > 0 && n <= count) loss += dt * beta() * taken;
      for (std::size_t i = 0; i < 2; ++i) u_[i] += dt * v_[i];
    }
    std::vector<StructureEnergy> energies(1);
    return balance.line(energies);
  }
  double beta() const { return systems_[0].damping.beta; }
  double loss = 0;  ///< of the closed steps [J]

 private:
  std::array<std::array<double, 2>, 2> k_;
  std::vector<LinearSystem> systems_;
  std::array<double, 2> u_{0.1, -0.2}, v_{1, 0.5}, mean_{};
};

TEST(EnergyBalance, FindsWhatStiffnessProportionalDampingTookFromTheWorkOfItsForce) {
  for (const int steps : {1, 2, 50, 400}) {
    TwoMasses masses(0);
    const EnergyLine line = masses.line_after(steps);
    EXPECT_NEAR(line.rows[ledger_row("damping_loss")], masses.loss, 1e-14) << steps;
    EXPECT_NEAR(line.residual, 0, 1e-14) << steps;
    EXPECT_GT(line.rows[ledger_row("damping_loss")], 1e-3);
  }
}

TEST(EnergyBalance, ShowsAStiffnessThatIsNotSymmetric) {
  TwoMasses masses(1e-6);
  EXPECT_GT(std::abs(masses.line_after(20).residual), 1e-10);
}

}  // namespace energy_balance_test
}  // namespace pounding
