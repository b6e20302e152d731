#include "observers/watchdog.h"

#include <memory>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "checks/run_doubts.h"
#include "checks/warnings.h"
#include "common/error.h"

namespace pounding {
namespace watchdog_test {

EnergyLine taken(double damping, double devices, double bars) {
  EnergyLine line;
  line.time = 2.5;
  line.rows[ledger_row("damping_loss")] = damping;
  line.rows[ledger_row("device_work")] = devices + bars;
  line.rows[ledger_row("link_loss")] = bars;
  return line;
}

std::string complaint(const EnergyLine& line) {
  try {
    watch_passivity(line, 1000);
  } catch (const DivergenceError& error) {
    return error.what();
  }
  return "";
}

TEST(Watchdog, StopsWhatGaveMoreEnergyThanItTook) {
  EXPECT_NE(complaint(taken(0, 0, -2e-3)).find("links gave 0.002 J"), std::string::npos);
  EXPECT_NE(complaint(taken(0, 5, -2e-3)).find("links"), std::string::npos);
  EXPECT_NE(complaint(taken(1, -1.002, 0)).find("damping gave 0.002 J"), std::string::npos);
  EXPECT_NE(complaint(taken(0, -2e-3, 0)).find("t = 2.5 s"), std::string::npos);
}

TEST(Watchdog, BearsRoundOffAndRegionsWithLessDampingThanTheirStructure) {
  EXPECT_EQ(complaint(taken(0, 0, 0)), "");
  EXPECT_EQ(complaint(taken(0, 0, -5e-4)), "");
  EXPECT_EQ(complaint(taken(3, -2, 0)), "");
  EXPECT_EQ(complaint(taken(3, 2, 1)), "");
}

/// Whether a residual of the energy identity [J] stops a run whose largest term is 1000 J.
bool stops(double residual, double time_step, double displacement_mass = 0) {
  Model model;
  model.motion = std::make_unique<GroundMotion>(std::array<std::optional<MotionComponent>, 3>{},
                                                Resampling::band_limited);
  model.time_step = time_step;
  model.systems.resize(1);
  model.systems[0].total_mass = 50;
  model.systems[0].gravity = {0, 6, -8};
  model.buildings.resize(1);
  model.buildings[0].limits.largest = {1e4, ""};
  StructureEnergy energy;
  energy.displacement_mass = displacement_mass;
  EnergyLine line;
  line.residual = residual;
  try {
    watch_identity(model, line, std::vector{energy}, 1000);
  } catch (const DivergenceError&) {
    return true;
  }
  return false;
}

TEST(Watchdog, StopsAtAMillionthOfTheLargestEnergy) {
  EXPECT_FALSE(stops(0, 0));
  EXPECT_FALSE(stops(0.9e-3, 0));
  EXPECT_FALSE(stops(-0.9e-3, 0));
  EXPECT_TRUE(stops(1.1e-3, 0));
  EXPECT_TRUE(stops(-1.1e-3, 0));
}

TEST(Watchdog, AllowsForTheSpeedOfOneStepAndForRoundOffFarFromRest) {
  // 50 kg that gravity makes 1 m/s fast in 0.1 s: 25 J, of which a millionth.
  EXPECT_FALSE(stops(1.02e-3, 0.1));
  EXPECT_TRUE(stops(1.03e-3, 0.1));
  // 1e-14 omega^2 u^T M u, 1e-3 J here.
  EXPECT_FALSE(stops(1.9e-3, 0, 1000));
  EXPECT_TRUE(stops(2.1e-3, 0, 1000));
}

TEST(Warnings, NameContactProblemsThatWereNotSolvedToTheEnd) {
  EXPECT_TRUE(contact_warnings(0).empty());
  EXPECT_TRUE(contact_warnings(1e-9).empty());
  ASSERT_EQ(contact_warnings(2e-8).size(), 1u);
  EXPECT_NE(contact_warnings(2e-8)[0].find("residual 2e-08"), std::string::npos);
}

TEST(Warnings, DoubtDampingAboveHalfOfTheCriticalUpTo50Hz) {
  constexpr double pi = std::numbers::pi;
  const auto doubts = [](double alpha, double beta, const std::vector<double>& frequencies) {
    Structure structure;
    structure.name = "s";
    structure.damping = {alpha, beta};
    ModalResult modal;
    for (const double frequency : frequencies) {
      modal.modes.emplace_back().frequency = frequency;
    }
    return damping_warnings(structure, modal);
  };
  // alpha / (2 omega) + beta omega / 2
  EXPECT_TRUE(doubts(0.49 * 4 * pi * 2, 0, {2, 10}).empty());
  ASSERT_EQ(doubts(0.51 * 4 * pi * 2, 0, {2, 10}).size(), 1u);
  EXPECT_NE(doubts(0.51 * 4 * pi * 2, 0, {2, 10})[0].find("damp 51 % of critical at 2 Hz"),
            std::string::npos);
  EXPECT_TRUE(doubts(0, 0.49 / (pi * 49), {2, 49}).empty());
  EXPECT_EQ(doubts(0, 0.51 / (pi * 49), {2, 49}).size(), 1u);
  EXPECT_TRUE(doubts(0, 0.51 / (pi * 51), {2, 51}).empty());  // beyond 50 Hz
  EXPECT_EQ(doubts(0, 0.51 / (pi * 51), {51}).size(), 1u);    // but for the first mode
  EXPECT_EQ(doubts(0, 0.51 / (pi * 50), {}).size(), 1u);
}

TEST(Warnings, DoNotTakeRoundOffOfAFreeMotionForAFrequency) {
  Structure structure;
  structure.damping = {0.5, 0};
  ModalResult modal;
  modal.modes.resize(2);
  modal.modes[0].frequency = 1e-5;
  modal.modes[1].frequency = 3;
  EXPECT_EQ(damping_warnings(structure, modal).size(), 1u);
  modal.modes[0].location = "a node";  // of modes near zero only
  EXPECT_TRUE(damping_warnings(structure, modal).empty());
}

TEST(Warnings, DoubtDisplacementsAboveATwentiethOfTheModel) {
  EXPECT_TRUE(displacement_warnings(0, 8).empty());
  EXPECT_TRUE(displacement_warnings(0.399, 8).empty());
  ASSERT_EQ(displacement_warnings(0.401, 8).size(), 1u);
  EXPECT_NE(displacement_warnings(0.401, 8)[0].find("reach 0.401 m in a model of 8 m"),
            std::string::npos);
}

}  // namespace watchdog_test
}  // namespace pounding
