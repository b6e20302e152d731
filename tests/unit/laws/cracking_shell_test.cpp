#include "laws/cracking_shell.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace pounding::interactions {
namespace cracking_shell_test {

using Damage = CrackingShell::Damage;

constexpr double young = 30e9, thickness = 0.2;
const ShellCracking usual{3.7e5, 1.5e4, 0.02, 1, 0.3};

double dot(const ShellVector& a, const ShellVector& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

ShellVector random_strains(std::mt19937& random, double size) {
  std::normal_distribution<double> normal;
  ShellVector e{};
  for (std::size_t i = 0; i < 6; ++i) e[i] = size * normal(random) * (i < 3 ? 1 : 6 / thickness);
  return e;
}

TEST(CrackingShell, MeetsTheClosedFormInTension) {
  // Without lateral contraction force over strain has two slopes.
  const CrackingShell shell(young, 0, thickness, usual);
  const double stiffness = young * thickness, first = usual.force / stiffness;
  for (const double ratio : {0.5, 1.0, 1.5, 7.0, 40.0}) {
    const ShellVector e{ratio * first, 0, 0, 0, 0, 0};
    const Damage damage = shell.grown(e, {});
    const double expected = usual.force * (ratio < 1 ? ratio : 1 + usual.tension * (ratio - 1));
    EXPECT_NEAR(shell.forces(e, damage)[0] / expected, 1, 1e-12) << ratio;
    EXPECT_NEAR(damage.lower, std::max(0.0, ratio - 1), 1e-12 * ratio);
    EXPECT_DOUBLE_EQ(damage.upper, damage.lower);
    EXPECT_NEAR(shell.loading(e), ratio, 1e-12 * ratio);
    const ShellVector back{-e[0], 0, 0, 0, 0, 0};  // closed, the shell is sound
    EXPECT_NEAR(shell.forces(back, damage)[0] / (-stiffness * e[0]), 1, 1e-13);
  }
}

TEST(CrackingShell, MeetsTheClosedFormInShearAndBending) {
  const double poisson = 0.2;
  const CrackingShell shell(young, poisson, thickness, usual);
  const double mu = young / (2 * (1 + poisson)) * thickness;
  for (const double g : {1e-5, 1e-4, 4e-4, 3e-3}) {
    const ShellVector e{0, 0, g, 0, 0, 0};
    const double d =
        std::max(0.0, std::sqrt(mu * (1 - usual.tension) * g * g / 8 / shell.threshold()) - 1);
    const double kept = (1 + usual.tension * d) / (1 + d);
    const Damage damage = shell.grown(e, {});
    EXPECT_NEAR(damage.lower, d, 1e-12 * (1 + d));
    EXPECT_NEAR(shell.forces(e, damage)[2] / (mu * g * (kept + 1) / 2), 1, 1e-12) << g;
  }
  // Bent to a cylinder moment over curvature has two slopes.
  const double rigidity = young * std::pow(thickness, 3) / 12 / (1 - poisson * poisson);
  const auto bent = [&](double k) {
    const ShellVector e{0, 0, 0, 0, k, 0};
    const Damage damage = shell.grown(e, {});
    EXPECT_EQ(k > 0 ? damage.lower : damage.upper, 0);
    return shell.forces(e, damage)[4];
  };
  const double unit = shell.loading({0, 0, 0, 0, 1, 0});
  for (const double side : {-1.0, 1.0}) {
    for (const double ratio : {0.6, 1.0, 2.5, 30.0}) {
      const double expected = ratio < 1 ? ratio : 1 + usual.bending * (ratio - 1);
      EXPECT_NEAR(side * bent(side * ratio / unit) * unit / rigidity / expected, 1, 1e-12);
    }
  }
}

/// SSNS106A of Code_Aster: a strip in tension, 2e-4 long at the end, free to contract; energy that
/// damage took per area, as stored in its test file.
TEST(CrackingShell, TakesWhatTheStripOfCodeAsterTakes) {
  const CrackingShell shell(35.62e9, 0.18, 0.1, {3.7e5, 9e3, 0.02, 1, 0.32});
  for (const auto& [strain, lost] : {std::pair(1.5e-4, 8.2519177), std::pair(2e-4, 17.281653)}) {
    double low = -strain, high = 0;
    Damage damage;
    for (int n = 0; n < 100; ++n) {
      const double across = (low + high) / 2;
      const ShellVector e{strain, across, 0, 0, 0, 0};
      damage = shell.grown(e, {});
      (shell.forces(e, damage)[1] > 0 ? high : low) = across;
    }
    EXPECT_NEAR(shell.threshold() * (damage.lower + damage.upper) / lost, 1, 1e-3);
  }
}

/// Biaxial states: damages are at rest where their drives are Y0, forces are the slope of the
/// energy with damages that follow.
TEST(CrackingShell, ForcesAreTheSlopeOfTheEnergyThatIsLeft) {
  std::mt19937 random(5);
  for (const double compression : {1.0, 0.4}) {
    ShellCracking cracking = usual;
    cracking.compression = compression;
    const CrackingShell shell(young, 0.2, thickness, cracking);
    const auto left = [&](const ShellVector& e) {
      const Damage d = shell.grown(e, {});
      return shell.energy(e, d) + shell.threshold() * (d.lower + d.upper);
    };
    for (int n = 0; n < 200; ++n) {
      const ShellVector e = random_strains(random, 3e-4);
      const ShellVector way = random_strains(random, 3e-4);
      const Damage d = shell.grown(e, {});
      const double small = 1e-4;
      ShellVector more = e, less = e;
      for (std::size_t i = 0; i < 6; ++i) {
        more[i] += small * way[i];
        less[i] -= small * way[i];
      }
      const double slope = (left(more) - left(less)) / (2 * small);
      const ShellVector sound = shell.sound_forces(e);
      const double scale = std::sqrt(dot(sound, e) * dot(shell.sound_forces(way), way));
      EXPECT_NEAR(dot(shell.forces(e, d), way) / scale, slope / scale, 1e-6);
      EXPECT_NEAR(dot(shell.forces(e, d), e) / 2 / shell.energy(e, d), 1, 1e-12);
      // From anywhere below, the damages are the same to round-off.
      const Damage again = shell.grown(e, {d.lower * 0.3, d.upper * 0.9});
      EXPECT_NEAR(again.lower, d.lower, 1e-12 * (1 + d.lower));
      EXPECT_NEAR(again.upper, d.upper, 1e-12 * (1 + d.upper));
    }
  }
}

TEST(CrackingLaw, NeverGivesEnergyWhateverTheStepsAre) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform;
  for (int trial = 0; trial < 20; ++trial) {
    const ShellCracking cracking{1e5 + 1e6 * uniform(random), 1e3 + 1e5 * uniform(random),
                                 0.9 * uniform(random), uniform(random), 0.9 * uniform(random)};
    const CrackingLaw law(CrackingShell(young, 0.45 * uniform(random), thickness, cracking));
    std::vector<double> memory(CrackingLaw::memory_size(), 0.0);
    ShellVector e{};
    double lost = 0, work = 0, stored = 0;
    for (int n = 0; n < 50000; ++n) {
      const ShellVector to = random_strains(random, 5e-4);
      const double part = std::pow(uniform(random), 3);
      const ShellVector before = law.forces(memory);
      ShellVector way{};
      for (std::size_t i = 0; i < 6; ++i) way[i] = part * (to[i] - e[i]);
      for (std::size_t i = 0; i < 6; ++i) e[i] += way[i];
      law.advance(e, memory);
      const ShellVector after = law.forces(memory);
      work += (dot(before, way) + dot(after, way)) / 2;
      const double rounded =
          1e-13 * (lost + stored + law.stored(memory) + dot(law.shell().sound_forces(way), way));
      EXPECT_GE(law.lost(memory), lost - rounded);
      lost = law.lost(memory);
      stored = law.stored(memory);
      ASSERT_TRUE(std::isfinite(lost));
    }
    EXPECT_GT(lost, 0);
    // Half of the force in each step: energy between steps less the half that is yet to come.
    EXPECT_NEAR(work, lost + stored, 1e-9 * (std::abs(work) + lost + stored));
  }
}

}  // namespace cracking_shell_test
}  // namespace pounding::interactions
