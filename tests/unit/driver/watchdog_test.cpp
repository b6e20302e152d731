#include "driver/watchdog.h"

#include <string>

#include <gtest/gtest.h>

#include "common/error.h"
#include "driver/warnings.h"

namespace pounding {
namespace {

EnergyLine taken(double damping, double devices, double bars) {
  EnergyLine line;
  line.time = 2.5;
  line.damping_loss = damping;
  line.device_work = devices + bars;
  line.bar_loss = bars;
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
  EXPECT_NE(complaint(taken(0, 0, -2e-3)).find("tension-only bars gave 0.002 J"),
            std::string::npos);
  EXPECT_NE(complaint(taken(0, 5, -2e-3)).find("tension-only bars"), std::string::npos);
  EXPECT_NE(complaint(taken(1, -1.002, 0)).find("damping gave 0.002 J"), std::string::npos);
  EXPECT_NE(complaint(taken(0, -2e-3, 0)).find("t = 2.5 s"), std::string::npos);
}

TEST(Watchdog, BearsRoundOffAndRegionsWithLessDampingThanTheirStructure) {
  EXPECT_EQ(complaint(taken(0, 0, 0)), "");
  EXPECT_EQ(complaint(taken(0, 0, -5e-4)), "");
  EXPECT_EQ(complaint(taken(3, -2, 0)), "");
  EXPECT_EQ(complaint(taken(3, 2, 1)), "");
}

TEST(Warnings, NameContactProblemsThatWereNotSolvedToTheEnd) {
  EXPECT_TRUE(contact_warnings(0).empty());
  EXPECT_TRUE(contact_warnings(1e-7).empty());
  ASSERT_EQ(contact_warnings(2e-6).size(), 1u);
  EXPECT_NE(contact_warnings(2e-6)[0].find("residual 2e-06"), std::string::npos);
}

TEST(Warnings, DoubtDisplacementsAboveATwentiethOfTheModel) {
  EXPECT_TRUE(displacement_warnings(0, 8).empty());
  EXPECT_TRUE(displacement_warnings(0.399, 8).empty());
  ASSERT_EQ(displacement_warnings(0.401, 8).size(), 1u);
  EXPECT_NE(displacement_warnings(0.401, 8)[0].find("reach 0.401 m in a model of 8 m"),
            std::string::npos);
}

}  // namespace
}  // namespace pounding
