#include "motion/support_motion.h"

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "motion_files.h"

namespace pounding {
namespace support_motion_test {

using ::testing::HasSubstr;
using testing_support::MotionFiles;
using testing_support::refusal;

class SupportMotionTest : public MotionFiles {
 protected:
  MotionComponent record(const std::string& name, const std::string& text, double scale = 1) const {
    return {RecordedMotion{write(name, text), "m/s2", 0.5, 0}, 0, scale};
  }
  GroundMotion ground_along_x() const {
    return GroundMotion({record("ground", "0\n1\n-4\n2\n"), std::nullopt, std::nullopt},
                        Resampling::linear);
  }
  static std::vector<double> at(const SupportMotion& motion, double t) {
    std::vector<double> values(motion.columns().size());
    motion.evaluate(t, values);
    return values;
  }
};

TEST_F(SupportMotionTest, HasAColumnForWhatDiffersFromTheGroundOnly) {
  GroundMotion ground = ground_along_x();
  Support same{"same", {}};
  Support late{"late", {}};
  late.delay = 0.25;
  Support own{"own", {}};
  own.motion[1] = record("own", "0\n2\n0\n");
  own.motion[5] = record("turn", "0\n0.5\n0\n", 2);
  own.point = {1, 2, 3};
  const std::vector<Support> supports{same, late, own};
  const SupportMotion motion(supports, ground, Resampling::linear);
  ASSERT_EQ(motion.columns().size(), 3U);
  EXPECT_EQ(motion.describe(0), "support late, x");
  EXPECT_EQ(motion.describe(1), "support own, y");
  EXPECT_EQ(motion.describe(2), "support own, rz");
  EXPECT_EQ(motion.columns()[2].point, (Vector3{1, 2, 3}));
  const std::vector<double> values = at(motion, 0.5);
  EXPECT_DOUBLE_EQ(values[0], ground.acceleration(0, 0.25) - ground.acceleration(0, 0.5));
  EXPECT_DOUBLE_EQ(values[1], 2);
  EXPECT_DOUBLE_EQ(values[2], 1);
}

TEST_F(SupportMotionTest, IsRelativeToTheGround) {
  GroundMotion ground = ground_along_x();
  Support still{"still", {}};
  still.factor[0] = 0;
  Support own{"own", {}};
  own.motion[0] = record("own", "3\n3\n");
  const std::vector<Support> supports{still, own};
  const SupportMotion motion(supports, ground, Resampling::linear);
  for (const double t : {0.0, 0.4, 0.75, 1.2, 5.0}) {
    const std::vector<double> values = at(motion, t);
    EXPECT_EQ(values[0], -ground.acceleration(0, t));
    EXPECT_EQ(values[1], (t <= 0.5 ? 3 : 0) - ground.acceleration(0, t));
  }
}

TEST_F(SupportMotionTest, RecordsSetInByTheTimesOfAll) {
  const auto at_times = [&](const std::string& name, double first, double value) {
    std::string text;
    for (int i = 0; i < 3; ++i) {
      text += std::to_string(first + 0.1 * i) + " " + std::to_string(i == 1 ? value : 0) + "\n";
    }
    MotionComponent component;
    component.source = RecordedMotion{write(name, text), "m/s2", 0, 0};
    return component;
  };
  GroundMotion ground({at_times("x", 12, 1), at_times("y", 10, 1), std::nullopt},
                      Resampling::linear);
  EXPECT_NEAR(ground.acceleration(0, 2.1), 1, 1e-9);
  EXPECT_NEAR(ground.acceleration(1, 0.1), 1, 1e-9);
  EXPECT_EQ(ground.acceleration(0, 1.9), 0);
  EXPECT_NEAR(ground.descriptions()[0].start, 2, 1e-9);
  EXPECT_TRUE(ground.doubts().empty());
  Support near{"near", {}}, far{"far", {}};
  near.motion[0] = at_times("near", 9.5, 3);
  far.motion[0] = at_times("far", 13.5, 5);
  far.motion[4] = at_times("turn", 14, 7);
  const std::vector<Support> supports{near, far};
  const SupportMotion motion(supports, ground, Resampling::linear);
  EXPECT_NEAR(ground.origin(), 9.5, 1e-12);
  EXPECT_NEAR(ground.acceleration(0, 2.6), 1, 1e-9);
  EXPECT_NEAR(at(motion, 0.1)[0], 3, 1e-9);
  EXPECT_NEAR(at(motion, 0.1)[1], 0, 1e-9);
  EXPECT_NEAR(at(motion, 4.1)[1], 5, 1e-9);
  EXPECT_NEAR(at(motion, 4.6)[2], 7, 1e-9);
  EXPECT_THAT(motion.source(1), HasSubstr("sets in at 4 s"));
}

TEST_F(SupportMotionTest, ReachIsTheIntegralOfItsRecord) {
  GroundMotion ground({std::nullopt, std::nullopt, std::nullopt}, Resampling::linear);
  Support own{"own", {}};
  own.motion[0] = record("own", "1\n1\n1\n-1\n-1\n-1\n");
  const std::vector<Support> supports{own};
  const SupportMotion motion(supports, ground, Resampling::linear);
  const SupportMotion::Reach reach = motion.reach(0);
  EXPECT_NEAR(reach.largest_speed, 1.125, 1e-6);  // 1 s at 1 m/s2, then a ramp through zero
  EXPECT_NEAR(reach.end_velocity, 0, 1e-12);
  EXPECT_NEAR(reach.end, 0.5 + 0.5 + 0.125 - 0.25 / 3 + 0.5, 1e-5);
  EXPECT_EQ(reach.peak, 1);
  ASSERT_EQ(motion.doubts().size(), 1U);
  EXPECT_THAT(motion.doubts()[0], HasSubstr("support own, x: its records leave it"));
}

TEST_F(SupportMotionTest, RefusesWhatNoGroundDoes) {
  GroundMotion ground = ground_along_x();
  Support own{"own", {}};
  own.motion[3] = record("turn", "0\n1\n0\n", 1e8);
  const std::vector<Support> supports{own};
  EXPECT_THAT(refusal([&] { SupportMotion(supports, ground, Resampling::linear); }),
              HasSubstr("support own, rotation"));
}

}  // namespace support_motion_test
}  // namespace pounding
