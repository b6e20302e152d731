#include "motion/ground_motion.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "motion_files.h"

namespace pounding {
namespace ground_motion_test {

using ::testing::HasSubstr;
using testing_support::MotionFiles;
using testing_support::refusal;

class GroundMotionTest : public MotionFiles {
 protected:
  using Components = std::array<std::optional<MotionComponent>, 3>;

  MotionComponent record(const std::string& text, double step, double pga = 0,
                         double scale = 1) const {
    const std::string name = "record" + std::to_string(std::hash<std::string>{}(text));
    return {RecordedMotion{write(name, text), "m/s2", step, 0}, pga, scale};
  }

  const std::string shape = "0\n1\n-4\n2\n";
};

TEST_F(GroundMotionTest, PartsAddUpToTheMotion) {
  const GroundMotion motion(Components{record(shape, 0.5), std::nullopt, std::nullopt},
                            Resampling::linear);
  const GroundMotion sets_in = motion.part(GroundMotion::Part::sets_in, 0.25, 1.25);
  const GroundMotion leaves = motion.part(GroundMotion::Part::leaves, 0.25, 1.25);
  for (const double t : {0.0, 0.2, 0.5, 0.7, 1.0, 1.3, 1.5}) {
    EXPECT_NEAR(sets_in.acceleration(0, t) + leaves.acceleration(0, t), motion.acceleration(0, t),
                1e-15);
  }
  const double share = (1 - std::cos(std::acos(-1.0) / 4)) / 2;  // a quarter of the way up
  EXPECT_NEAR(sets_in.acceleration(0, 0.5), share * 1, 1e-15);
  EXPECT_EQ(sets_in.acceleration(0, 1.5), 2);
  EXPECT_EQ(leaves.acceleration(0, 1.5), 0);
}

TEST_F(GroundMotionTest, TimesCountFromAnOrigin) {
  const GroundMotion motion(Components{record(shape, 0.5), std::nullopt, std::nullopt},
                            Resampling::linear);
  EXPECT_DOUBLE_EQ(motion.counted_from(0.4).acceleration(0, 0.1), motion.acceleration(0, 0.5));
  EXPECT_EQ(motion.counted_from(1).acceleration(0, 0.75), 0);
}

TEST_F(GroundMotionTest, LinearBetweenSamplesAndZeroOutside) {
  const GroundMotion motion(Components{record(shape, 0.5), std::nullopt, std::nullopt},
                            Resampling::linear);
  EXPECT_DOUBLE_EQ(motion.acceleration(0, 0.25), 0.5);
  EXPECT_DOUBLE_EQ(motion.acceleration(0, 0.5), 1);
  EXPECT_NEAR(motion.acceleration(0, 0.6), 0, 1e-15);
  EXPECT_DOUBLE_EQ(motion.acceleration(0, 1.25), -1);
  EXPECT_DOUBLE_EQ(motion.acceleration(0, 1.5), 2);
  EXPECT_EQ(motion.acceleration(0, std::nextafter(1.5, 2)), 0);
  EXPECT_EQ(motion.acceleration(0, 1e300), 0);
  EXPECT_EQ(motion.acceleration(0, -1e-9), 0);
  EXPECT_EQ(motion.acceleration(0, NAN), 0);
  EXPECT_EQ(motion.acceleration(1, 0.5), 0);
  EXPECT_EQ(motion.component(0).duration(), 1.5);
  EXPECT_EQ(motion.peak_acceleration(), 4);
  static_assert(noexcept(motion.acceleration(0, 0.0)));
}

TEST_F(GroundMotionTest, WaveFromBelowIsTheExactIntegralAndTheGroundRests) {
  GroundMotion motion(Components{record(shape, 0.5), std::nullopt, record("1\n-1\n", 0.1)},
                      Resampling::linear);
  Vector3 v{9, 9, 9};
  motion.evaluate_incident(1, v);
  EXPECT_EQ(v, (Vector3{0, 0, 0}));
  motion.enter_from_below();
  EXPECT_TRUE(motion.from_below());
  EXPECT_EQ(motion.acceleration(0, 0.5), 0);
  EXPECT_EQ(motion.peak_acceleration(), 0);
  EXPECT_FALSE(motion.active(0));
  EXPECT_EQ(motion.incident(0).acceleration.size(), 4U);
  motion.evaluate_incident(0.25, v);
  EXPECT_DOUBLE_EQ(v[0], 0.0625);  // t^2
  EXPECT_EQ(v[1], 0);
  EXPECT_NEAR(v[2], 0, 1e-15);
  motion.evaluate_incident(0.75, v);
  EXPECT_DOUBLE_EQ(v[0], 0.25 + 0.25 * (1 - 1.5) / 2);  // from 1 to -1.5
  motion.evaluate_incident(0.05, v);
  EXPECT_DOUBLE_EQ(v[2], 0.025);
  motion.evaluate_incident(1e9, v);
  EXPECT_DOUBLE_EQ(v[0], 0.25 - 0.75 - 0.5);  // keeps its last value
  motion.evaluate_incident(-1, v);
  EXPECT_EQ(v, (Vector3{0, 0, 0}));
  ASSERT_FALSE(motion.doubts().empty());
  EXPECT_THAT(motion.doubts().back(), HasSubstr("motion x: the wave from below ends at -1 m/s"));
}

TEST_F(GroundMotionTest, ThreeDirectionsOfTheirOwnLengthAndScale) {
  const GroundMotion motion(
      Components{record(shape, 0.5, 2), std::nullopt, record("1\n3\n", 0.1, 0, -0.5)},
      Resampling::linear);
  Vector3 a{9, 9, 9};
  motion.evaluate(0.05, a);
  EXPECT_DOUBLE_EQ(a[0], 0.05);
  EXPECT_EQ(a[1], 0);
  EXPECT_DOUBLE_EQ(a[2], -1);
  motion.evaluate(1, a);
  EXPECT_DOUBLE_EQ(a[0], -2);  // the peak of 4 brought to 2
  EXPECT_EQ(a[2], 0);
  EXPECT_TRUE(motion.active(0));
  EXPECT_FALSE(motion.active(1));
  EXPECT_EQ(motion.component(2).acceleration.size(), 2u);
  EXPECT_EQ(motion.component(0).duration(), 1.5);
  EXPECT_DOUBLE_EQ(motion.peak_acceleration(), 2.5);
}

TEST_F(GroundMotionTest, NoMotionAtAll) {
  const GroundMotion motion(Components{}, Resampling::band_limited);
  EXPECT_EQ(motion.acceleration(2, 1), 0);
  EXPECT_EQ(motion.component(2).duration(), 0);
  EXPECT_EQ(motion.peak_acceleration(), 0);
}

TEST_F(GroundMotionTest, BandLimitedResamplingFollowsASineBetweenItsSamples) {
  // 20 Hz sampled at 100 Hz: straight lines miss up to 1 - cos(pi f h) = 19 % of the peak.
  std::string text;
  for (int i = 0; i <= 1000; ++i)
    text += std::to_string(std::sin(40 * M_PI * 0.01 * i + 0.3) *
                           std::exp(-std::pow((i - 500) / 150.0, 2))) +
            "\n";
  const Components components{record(text, 0.01), std::nullopt, std::nullopt};
  const GroundMotion linear(components, Resampling::linear);
  const GroundMotion limited(components, Resampling::band_limited);
  double linear_error = 0, limited_error = 0;
  for (double t = 4.5; t < 5.5; t += 1.3e-4) {
    const double exact = std::sin(40 * M_PI * t + 0.3) * std::exp(-std::pow((t - 5) / 1.5, 2));
    linear_error = std::max(linear_error, std::abs(linear.acceleration(0, t) - exact));
    limited_error = std::max(limited_error, std::abs(limited.acceleration(0, t) - exact));
  }
  EXPECT_GT(linear_error, 0.1);
  EXPECT_LT(limited_error, 6e-4);  // straight lines of 5e-4 s: (omega h)^2 / 8
  EXPECT_LE(limited.component(0).time_step, 5e-4);
  EXPECT_EQ(limited.component(0).duration(), linear.component(0).duration());
}

TEST_F(GroundMotionTest, SyntheticComponent) {
  const std::string target = write("target.csv", "# shape\nHz, ratio\n1, 1\n5, 2.5\n30, 1\n");
  SyntheticMotion synthetic{target, 4, 10, {1, 5}};
  const GroundMotion motion(
      Components{std::nullopt, MotionComponent{synthetic, 1.5, 1}, std::nullopt},
      Resampling::linear);
  EXPECT_EQ(motion.peak_acceleration(), 1.5);
  EXPECT_DOUBLE_EQ(motion.component(1).duration(), 10);
  EXPECT_THAT(refusal([&] {
                GroundMotion(
                    Components{MotionComponent{synthetic, 0, 1}, std::nullopt, std::nullopt},
                    Resampling::linear);
              }),
              HasSubstr("motion x: a synthetic motion needs a pga"));
}

TEST_F(GroundMotionTest, ZeroRecordIsAMotionButCannotBeScaled) {
  const GroundMotion rest(Components{std::nullopt, record("0\n0\n0\n", 0.1), std::nullopt},
                          Resampling::band_limited);
  EXPECT_EQ(rest.acceleration(1, 0.1), 0);
  EXPECT_TRUE(rest.active(1));
  EXPECT_THAT(refusal([&] {
                GroundMotion(Components{std::nullopt, record("0\n0\n0\n", 0.1, 2), std::nullopt},
                             Resampling::linear);
              }),
              HasSubstr("motion y: "));
}

TEST_F(GroundMotionTest, TakesAThousandG) {
  EXPECT_NO_THROW(GroundMotion(
      Components{record("0\n9806\n", 0.05, 0, 1), std::nullopt, std::nullopt}, Resampling::linear));
}

TEST_F(GroundMotionTest, RefusesPeaksThatNoGroundHas) {
  const auto made = [&](const std::string& text, double pga, double scale) {
    return refusal([&] {
      GroundMotion(Components{record(text, 0.05, pga, scale), std::nullopt, std::nullopt},
                   Resampling::linear);
    });
  };
  EXPECT_THAT(made("0\n1e12\n", 0, 1), HasSubstr("1e+12 m/s2"));
  EXPECT_THAT(made("0\n3e5\n", 3, 1), HasSubstr("300000 m/s2"));
  EXPECT_THAT(made(shape, 1e12, 1), HasSubstr("scaled peak 1e+12"));
  EXPECT_THAT(made(shape, 0, 1e5), HasSubstr("scaled peak 400000"));
  SyntheticMotion synthetic{write("target.csv", "Hz, ratio\n1, 1\n5, 2.5\n30, 1\n"), 4, 10, {1, 5}};
  EXPECT_THAT(refusal([&] {
                GroundMotion(
                    Components{MotionComponent{synthetic, 1e12, 1}, std::nullopt, std::nullopt},
                    Resampling::linear);
              }),
              HasSubstr("pga 1e+12"));
}

TEST_F(GroundMotionTest, SaysWhatItUnderstood) {
  const GroundMotion motion(
      Components{record(shape, 0.05, 2), std::nullopt, record("0\n3\n", 0.1, 0, -0.5)},
      Resampling::band_limited);
  ASSERT_EQ(motion.descriptions().size(), 2u);
  const MotionDescription& x = motion.descriptions()[0];
  EXPECT_EQ(x.direction, "x");
  EXPECT_EQ(x.layout, "one column");
  EXPECT_EQ(x.unit, "m/s2 (as asked)");
  EXPECT_EQ(x.points, 4u);
  EXPECT_DOUBLE_EQ(x.time_step, 0.05);
  EXPECT_DOUBLE_EQ(x.duration, 0.15);
  EXPECT_DOUBLE_EQ(x.file_peak, 4);
  EXPECT_EQ(x.scaling, "to pga 2 m/s2");
  EXPECT_DOUBLE_EQ(x.pga, 2);
  EXPECT_EQ(motion.descriptions()[1].direction, "z");
  EXPECT_EQ(motion.descriptions()[1].scaling, "by -0.5");
  EXPECT_TRUE(motion.doubts().empty());
}

TEST_F(GroundMotionTest, DoubtsPeaksOfAnotherUnit) {
  const auto doubts = [&](double file_peak, double pga) {
    const std::string text = "0\n" + std::to_string(file_peak) + "\n";
    return GroundMotion(Components{record(text, 0.05, pga), std::nullopt, std::nullopt},
                        Resampling::linear)
        .doubts();
  };
  EXPECT_TRUE(doubts(3, 0).empty());
  EXPECT_TRUE(doubts(0.3, 3.43).empty());
  ASSERT_EQ(doubts(3, 0.35).size(), 1u);  // g meant
  EXPECT_THAT(doubts(3, 0.35)[0], HasSubstr("give 3.43"));
  ASSERT_EQ(doubts(0.35, 0).size(), 1u);  // a file in g
  EXPECT_THAT(doubts(0.35, 0)[0], HasSubstr("in g?"));
  ASSERT_EQ(doubts(34, 0).size(), 1u);  // a file in m/s2, said to be in g
  EXPECT_THAT(doubts(34, 0)[0], HasSubstr("above 3 g"));
  // A weak direction beside a strong one.
  EXPECT_TRUE(GroundMotion(Components{record("0\n3\n", 0.1), std::nullopt, record("0\n0.3\n", 0.1)},
                           Resampling::linear)
                  .doubts()
                  .empty());
}

TEST_F(GroundMotionTest, RefusesScalesThatMeanNothing) {
  const auto made = [&](double pga, double scale) {
    return refusal([&] {
      GroundMotion(Components{std::nullopt, std::nullopt, record(shape, 0.5, pga, scale)},
                   Resampling::linear);
    });
  };
  EXPECT_THAT(made(-1, 1), HasSubstr("motion z: pga -1"));
  EXPECT_THAT(made(NAN, 1), HasSubstr("pga"));
  EXPECT_THAT(made(0, INFINITY), HasSubstr("scale"));
  EXPECT_THAT(made(2, 3), HasSubstr("exclude"));
}

}  // namespace ground_motion_test
}  // namespace pounding
