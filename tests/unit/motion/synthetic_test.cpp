#include "motion/synthetic.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "motion/response_spectrum.h"
#include "motion_files.h"
#include "support/source_folder.h"

namespace pounding {
namespace synthetic_test {

using ::testing::HasSubstr;
using testing_support::MotionFiles;
using testing_support::refusal;

class Synthetic : public MotionFiles {
 protected:
  static TargetSpectrum target(const std::string& name) {
    return read_target_spectrum(source_folder() + "/petsc-options/spectra/" + name);
  }

  static SyntheticMotion seeded(int seed) {
    SyntheticMotion motion;
    motion.seed = seed;
    return motion;
  }

  struct Misfit {
    double rms = 0;
    double max = 0;
  };

  // How far the 5 % spectrum is from the target scaled to `pga`, as ln(PSA / target), over the
  // target's frequencies up to 50 Hz in steps of 1/40 of a decade.
  static Misfit misfit_of(const Accelerogram& a, const TargetSpectrum& shape, double pga) {
    std::vector<double> frequencies;
    const double high = std::min(50.0, shape.frequency.back());
    for (double f = shape.frequency.front(); f <= high; f *= std::pow(10, 1.0 / 40))
      frequencies.push_back(f);
    Misfit misfit;
    for (const auto& point : response_spectrum(a.acceleration, a.time_step, frequencies, 0.05)) {
      const double ratio = point.pseudo_acceleration / (pga * shape.at(point.frequency));
      misfit.rms += std::pow(std::log(ratio), 2) / static_cast<double>(frequencies.size());
      misfit.max = std::max(misfit.max, std::abs(std::log(ratio)));
    }
    misfit.rms = std::sqrt(misfit.rms);
    return misfit;
  }

  // FNV-1a over the bits of the values.
  static std::uint64_t checksum(const Accelerogram& a) {
    std::uint64_t hash = 14695981039346656037ull;
    for (const double value : a.acceleration)
      hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211ull;
    return hash;
  }
};

TEST_F(Synthetic, SpectrumFollowsTheTarget) {
  for (const std::string name :
       {"near_field_rock.csv", "alluvial.csv", "near_fault_pulse.csv", "long_period.csv"})
    for (int seed = 1; seed <= 4; ++seed) {
      const auto shape = target(name);
      const auto a = generate_accelerogram(shape, seeded(seed), 1.47);
      const auto misfit = misfit_of(a, shape, 1.47);
      EXPECT_LT(misfit.rms, 0.05) << name << seed;
      EXPECT_LT(misfit.max, 0.15) << name << seed;
    }
}

TEST_F(Synthetic, PeakIsExactAndEndsAreZero) {
  for (const double pga : {1e-3, 1.47, 9.81}) {
    const auto a = generate_accelerogram(target("near_field_rock.csv"), seeded(3), pga);
    EXPECT_EQ(a.peak(), pga);
    EXPECT_EQ(a.acceleration.front(), 0);
    EXPECT_EQ(a.acceleration.back(), 0);
    EXPECT_EQ(a.acceleration.size(), 5001u);
    EXPECT_EQ(a.time_step, 0.005);
  }
}

TEST_F(Synthetic, GroundComesBackToRestWithoutDrift) {
  for (const std::string name :
       {"near_field_rock.csv", "alluvial.csv", "near_fault_pulse.csv", "long_period.csv"})
    for (int seed = 1; seed <= 3; ++seed) {
      const auto record = generate_accelerogram(target(name), seeded(seed), 1);
      const auto& a = record.acceleration;
      const double h = record.time_step;
      double velocity = 0, displacement = 0, largest = 0;
      for (std::size_t i = 1; i < a.size(); ++i) {
        displacement += h * velocity + h * h * (a[i - 1] / 3 + a[i] / 6);
        velocity += h * (a[i - 1] + a[i]) / 2;
        largest = std::max(largest, std::abs(displacement));
      }
      EXPECT_NEAR(velocity, 0, 1e-14) << name << seed;
      EXPECT_NEAR(displacement, 0, 1e-13) << name << seed;
      // Ground displacement of the order of the softest spectral displacement, not of a drift.
      const auto shape = target(name);
      const double omega = 2 * M_PI * shape.frequency.front();
      EXPECT_LT(largest, 2 * shape.ratio.front() / (omega * omega)) << name << seed;
    }
}

TEST_F(Synthetic, EnvelopeRisesStaysAndDecays) {
  const auto record = generate_accelerogram(target("near_field_rock.csv"), seeded(5), 1);
  const auto level = [&](double from, double to) {
    double sum = 0;
    int count = 0;
    for (auto i = std::lround(from / 0.005); i < std::lround(to / 0.005); ++i, ++count)
      sum += std::pow(record.acceleration[static_cast<std::size_t>(i)], 2);
    return std::sqrt(sum / count);
  };
  const double plateau = level(2, 15);
  EXPECT_GT(plateau, 0.15);
  EXPECT_LT(level(0, 0.5), 0.2 * plateau);
  EXPECT_LT(level(23, 25), 0.25 * plateau);
  EXPECT_NEAR(level(2, 8) / level(8, 15), 1, 0.3);
}

TEST_F(Synthetic, WithoutRiseOrDecayItStillStartsAndEndsAtZero) {
  SyntheticMotion motion;
  motion.envelope = {0, 25};
  const auto a = generate_accelerogram(target("near_field_rock.csv"), motion, 1);
  EXPECT_EQ(a.peak(), 1);
  EXPECT_EQ(a.acceleration.front(), 0);
  EXPECT_EQ(a.acceleration.back(), 0);
}

TEST_F(Synthetic, SeedDecidesTheMotionToTheBit) {
  const auto shape = target("near_field_rock.csv");
  const auto one = checksum(generate_accelerogram(shape, seeded(1), 1.47));
  EXPECT_EQ(checksum(generate_accelerogram(shape, seeded(1), 1.47)), one);
  EXPECT_NE(checksum(generate_accelerogram(shape, seeded(2), 1.47)), one);
  EXPECT_NE(checksum(generate_accelerogram(shape, seeded(-1), 1.47)), one);
}

TEST_F(Synthetic, TargetReadsEitherOrderWithCommentsAndNames) {
  const auto up =
      read_target_spectrum(write("up.csv", "# shape\nHz,PSA/PGA\n1, 1\n10, 3\n30, 1\n"));
  const auto commas = read_target_spectrum(write("commas.csv", "Hz;PSA/PGA\n1,5;1\n10;3,25\n"));
  EXPECT_EQ(commas.frequency, (std::vector<double>{1.5, 10}));
  EXPECT_EQ(commas.ratio, (std::vector<double>{1, 3.25}));
  const auto down = read_target_spectrum(write("down.csv", "30;1\r\n10;3\r\n# middle\r\n\r\n1;1"));
  EXPECT_EQ(up.frequency, (std::vector<double>{1, 10, 30}));
  EXPECT_EQ(up.ratio, (std::vector<double>{1, 3, 1}));
  EXPECT_EQ(down.frequency, up.frequency);
  EXPECT_EQ(down.ratio, up.ratio);
  EXPECT_DOUBLE_EQ(up.at(std::sqrt(10.0)), std::sqrt(3.0));  // straight in log-log
  EXPECT_EQ(up.at(0.1), 1);
  EXPECT_EQ(up.at(100), 1);
}

TEST_F(Synthetic, RefusesTargetsThatAreNotOne) {
  const auto refused = [&](const std::string& text) {
    return refusal([&] { read_target_spectrum(write("target.csv", text)); });
  };
  EXPECT_THAT(refused("1, 1\n2, x\n"), HasSubstr("target.csv:2: "));
  EXPECT_THAT(refused("1, 1\n2, nan\n"), HasSubstr("target.csv:2: "));
  EXPECT_THAT(refused("1, 1\n2, 1, 5\n"), HasSubstr("target.csv:2: "));
  EXPECT_THAT(refused("0, 1\n2, 1\n"), HasSubstr("target.csv:1: "));
  EXPECT_THAT(refused("1, -1\n2, 1\n"), HasSubstr("target.csv:1: "));
  EXPECT_THAT(refused("1, 1\n"), HasSubstr("at least 2"));
  EXPECT_THAT(refused("1, 1\n3, 1\n2, 1\n"), HasSubstr("out of order"));
  EXPECT_THAT(refused("1, 1\n2, 1\n2, 3\n"), HasSubstr("out of order"));
}

TEST_F(Synthetic, RefusesParametersOutOfRange) {
  const auto shape = target("near_field_rock.csv");
  const auto refused = [&](SyntheticMotion motion, double pga) {
    return refusal([&] { generate_accelerogram(shape, motion, pga); });
  };
  SyntheticMotion motion;
  EXPECT_THAT(refused(motion, 0), HasSubstr("pga"));
  EXPECT_THAT(refused(motion, NAN), HasSubstr("pga"));
  motion.duration = 1;
  EXPECT_THAT(refused(motion, 1), HasSubstr("duration"));
  motion.duration = 1e9;
  EXPECT_THAT(refused(motion, 1), HasSubstr("duration"));
  motion.duration = 25;
  motion.envelope = {15, 2};
  EXPECT_THAT(refused(motion, 1), HasSubstr("envelope"));
  motion.envelope = {2, 26};
  EXPECT_THAT(refused(motion, 1), HasSubstr("envelope"));
}

TEST_F(Synthetic, RefusesATargetOutOfReach) {
  // No motion has a stiff oscillator see less than its own peak acceleration.
  const TargetSpectrum impossible{{1, 10, 40}, {0.2, 0.3, 0.2}};
  EXPECT_THAT(refusal([&] { generate_accelerogram(impossible, SyntheticMotion{}, 1); }),
              HasSubstr("% rms from"));
}

}  // namespace synthetic_test
}  // namespace pounding
