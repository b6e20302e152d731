#include <cmath>

#include <gtest/gtest.h>

#include "motion/spectrum_shape.h"

namespace pounding {
namespace spectral_distance_test {

/// 100 frequencies per decade from 0.5 to 400 Hz with values by a law.
template <typename Law>
std::vector<SpectrumPoint> spectrum(Law&& law) {
  std::vector<SpectrumPoint> points;
  for (double f = 0.5; f < 401; f *= std::pow(10, 0.01)) {
    points.push_back({.frequency = f, .pseudo_acceleration = law(f)});
  }
  return points;
}

TEST(SpectralDistance, DistanceIsTheRmsOfTheLogarithmOverLogarithmicFrequency) {
  const auto flat = spectrum([](double) { return 2.0; });
  const auto high = spectrum([](double f) { return f > 50 ? 2 * std::exp(0.3) : 2.0; });
  const ChannelDistance distance = spectral_distance("roof.x", high, flat);
  EXPECT_EQ(distance.rms[1], 0);             // 1-10 Hz
  EXPECT_NEAR(distance.rms[3], 0.3, 0.01);   // 50-150 Hz
  EXPECT_NEAR(distance.rms[4], 0.3, 1e-12);  // 150-400 Hz
  EXPECT_NEAR(distance.rms[0], 0.3 * std::sqrt(std::log(8) / std::log(400)), 0.005);
  EXPECT_NEAR(distance.largest, 0.3, 1e-12);
  EXPECT_GT(distance.at, 50);
  const ChannelDistance other_way = spectral_distance("roof.x", flat, high);
  EXPECT_NEAR(other_way.rms[0], distance.rms[0], 1e-12);
}

TEST(SpectralDistance, BandsWithoutTwoFrequenciesCountForNothing) {
  const std::vector<SpectrumPoint> two{{.frequency = 2, .pseudo_acceleration = 1},
                                       {.frequency = 8, .pseudo_acceleration = 1}};
  const ChannelDistance distance = spectral_distance("roof.x", two, two);
  EXPECT_EQ(distance.rms[1], 0);
  EXPECT_LT(distance.rms[4], 0);
  EXPECT_LT(rms_of_channels({&distance, 1}, 4), 0);
}

TEST(SpectralDistance, ChannelsCountAlike) {
  std::vector<ChannelDistance> channels(2);
  channels[0].rms[0] = 3;
  channels[1].rms[0] = 4;
  EXPECT_NEAR(rms_of_channels(channels, 0), std::sqrt(12.5), 1e-12);
}

TEST(SpectralDistance, DirectionsInWhichAProbeHardlyMovesAreLeftOut) {
  const auto constant = [](double value) { return spectrum([=](double) { return value; }); };
  const std::vector<std::vector<SpectrumPoint>> spectra{
      constant(1), constant(0.01), constant(1e-4), constant(1e-4), constant(1e-4), constant(0)};
  EXPECT_EQ(moving_channels(spectra), (std::vector<char>{1, 1, 0, 1, 1, 0}));
}

}  // namespace spectral_distance_test
}  // namespace pounding
