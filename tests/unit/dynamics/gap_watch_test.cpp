#include "dynamics/gap_watch.h"

#include <cmath>

#include <gtest/gtest.h>

namespace pounding {
namespace {

constexpr double time_step = 1e-3;
constexpr double margin = 0.5;
constexpr double energy = 8;      // J
constexpr double rate_norm = 3;   // kg^-1/2
constexpr double clearance = 10;  // m

/// Damping in a system that is only asked whether it has some.
class NoForce final : public Stiffness {
 public:
  void start(const StiffnessArgument&) const override {}
  void finish(const StiffnessArgument&, ForceReceiver&) const override {}
  void apply(Vec, Vec) const override {}
  Mat matrix() const override { return nullptr; }
};

std::vector<LinearSystem> one_system() {
  std::vector<LinearSystem> systems(1);
  systems[0].total_mass = 2;
  return systems;
}

/// The step of the next look after one at step 1, nothing touching.
std::int64_t next_look(std::span<const LinearSystem> systems, double energy_margin) {
  const std::vector<StructureEnergy> energies{{energy, 0, energy}};
  GapWatch watch(systems, {{energy_margin, rate_norm, {}}}, 0, time_step);
  watch.energies_known(0, energies);
  watch.looked(1, clearance, false);
  std::int64_t step = 2;
  while (!watch.due(step)) {
    ++step;
  }
  return step;
}

/// No gap closes faster than rate_norm sqrt(2 E / margin).
TEST(GapWatch, LooksBeforeTheEnergyCanCloseTheGap) {
  const double fastest = rate_norm * std::sqrt(2 * energy / margin);
  const double steps = clearance / (fastest * time_step);
  const auto found = static_cast<double>(next_look(one_system(), margin) - 1);
  EXPECT_LE(found, steps);
  EXPECT_GT(found, steps / 4);
}

TEST(GapWatch, TakesTheMarginOfExtraDamping) {
  auto systems = one_system();
  systems[0].extra_damping = std::make_unique<NoForce>();
  EXPECT_EQ(next_look(systems, margin), next_look(one_system(), margin));
  EXPECT_LT(next_look(systems, margin / 100), next_look(systems, margin));
}

TEST(GapWatch, LooksAtEveryStepWhereTheEnergyIsNoBound) {
  EXPECT_EQ(next_look(one_system(), -1e-3), 2);
}

}  // namespace
}  // namespace pounding
