#include "motion/support_motion.h"

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "motion_files.h"

namespace pounding {
namespace {

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
  const GroundMotion ground = ground_along_x();
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
  const GroundMotion ground = ground_along_x();
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

TEST_F(SupportMotionTest, ReachIsTheIntegralOfItsRecord) {
  const GroundMotion ground({std::nullopt, std::nullopt, std::nullopt}, Resampling::linear);
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
  const GroundMotion ground = ground_along_x();
  Support own{"own", {}};
  own.motion[3] = record("turn", "0\n1\n0\n", 1e8);
  const std::vector<Support> supports{own};
  EXPECT_THAT(refusal([&] { SupportMotion(supports, ground, Resampling::linear); }),
              HasSubstr("support own, rotation"));
}

}  // namespace
}  // namespace pounding
