#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "motion/fourier.h"

namespace pounding {
namespace resampling_test {

using std::numbers::pi;

// Sum of sines below the Nyquist frequency (50 Hz for 0.01 s), under a smooth bell when asked.
double band_limited(double t, bool bell) {
  const double sum = std::sin(2 * pi * 3.3 * t) + 0.7 * std::sin(2 * pi * 17.1 * t + 0.4) +
                     0.5 * std::sin(2 * pi * 31.7 * t + 1.1);
  return bell ? sum * std::exp(-std::pow((t - 5) / 0.8, 2)) : sum;
}

Accelerogram sampled(double step, double duration, bool bell) {
  Accelerogram a{{}, step};
  for (int i = 0; i <= std::lround(duration / step); ++i)
    a.acceleration.push_back(band_limited(i * step, bell));
  return a;
}

TEST(Resampling, BandLimitedBurstIsExact) {
  const auto fine = resample_band_limited(sampled(0.01, 10, true), 5e-4);
  EXPECT_DOUBLE_EQ(fine.time_step, 5e-4);
  ASSERT_EQ(fine.acceleration.size(), 20001u);
  for (std::size_t i = 0; i < fine.acceleration.size(); ++i)
    ASSERT_NEAR(fine.acceleration[i], band_limited(static_cast<double>(i) * 5e-4, true), 1e-8) << i;
}

TEST(Resampling, SinesAreExactAwayFromTheEndsOfTheRecord) {
  const auto fine = resample_band_limited(sampled(0.01, 20, false), 5e-4);
  double inside = 0, anywhere = 0;
  for (std::size_t i = 0; i < fine.acceleration.size(); ++i) {
    const double t = static_cast<double>(i) * fine.time_step;
    const double error = std::abs(fine.acceleration[i] - band_limited(t, false));
    anywhere = std::max(anywhere, error);
    if (t > 1 && t < 19) inside = std::max(inside, error);
  }
  EXPECT_LT(inside, 1e-3);
  EXPECT_LT(anywhere, 0.3);
}

TEST(Resampling, GivenValuesAreKept) {
  const auto coarse = sampled(0.01, 3, false);
  const auto fine = resample_band_limited(coarse, 0.003);  // four parts
  EXPECT_DOUBLE_EQ(fine.time_step, 0.0025);
  for (std::size_t i = 0; i < coarse.acceleration.size(); ++i)
    EXPECT_EQ(fine.acceleration[4 * i], coarse.acceleration[i]);
  EXPECT_DOUBLE_EQ(fine.duration(), coarse.duration());
}

TEST(Resampling, OneEndDoesNotRingIntoTheOther) {
  // A record that stops at full value: the silence at its beginning stays silent.
  Accelerogram a{std::vector<double>(1000, 0.0), 0.01};
  for (std::size_t i = 900; i < 1000; ++i)
    a.acceleration[i] = 1 - std::cos(pi * static_cast<double>(i - 900) / 99);
  const auto fine = resample_band_limited(a, 5e-4);
  for (std::size_t i = 0; i < 10000; ++i) ASSERT_NEAR(fine.acceleration[i], 0, 1e-5) << i;
  for (const double value : fine.acceleration) ASSERT_LT(std::abs(value), 2 + 1e-4);
}

TEST(Resampling, ConstantStaysConstantInTheMiddle) {
  const auto fine = resample_band_limited({std::vector<double>(2000, 2.5), 0.01}, 1e-3);
  for (const double value : fine.acceleration) ASSERT_NEAR(value, 2.5, 1e-3);
}

TEST(Resampling, ShortStepsAndShortRecordsPass) {
  const auto fine = sampled(4e-4, 0.1, false);
  EXPECT_EQ(resample_band_limited(fine, 5e-4).acceleration, fine.acceleration);
  EXPECT_EQ(resample_band_limited({{1.0}, 0.01}, 5e-4).acceleration.size(), 1u);
  const auto two = resample_band_limited({{1.0, 2.0}, 0.001}, 5e-4);
  ASSERT_EQ(two.acceleration.size(), 3u);
  EXPECT_NEAR(two.acceleration[1], 1.5, 0.5);
}

TEST(Resampling, FourierPairInvertsAndNamesItsFrequencies) {
  EXPECT_EQ(good_fourier_size(7), 8);
  EXPECT_EQ(good_fourier_size(5001), 5120);
  std::vector<double> wave(60);
  for (std::size_t i = 0; i < 60; ++i)
    wave[i] = 2 + std::cos(2 * pi * 7 * static_cast<double>(i) / 60);
  const auto spectrum = fourier(wave);
  ASSERT_EQ(spectrum.size(), 31u);
  EXPECT_NEAR(spectrum[0].real(), 120, 1e-12);
  EXPECT_NEAR(spectrum[7].real(), 30, 1e-12);
  EXPECT_NEAR(std::abs(spectrum[8]), 0, 1e-12);
  const auto back = inverse_fourier(spectrum, 60);
  for (std::size_t i = 0; i < 60; ++i) EXPECT_NEAR(back[i], wave[i], 1e-14);
}

}  // namespace resampling_test
}  // namespace pounding
