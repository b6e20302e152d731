#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "motion/signal_treatment.h"

namespace pounding {
namespace low_pass_test {

constexpr double pi = std::numbers::pi;

std::vector<double> sine(double frequency, double interval, std::size_t count) {
  std::vector<double> samples;
  for (std::size_t n = 0; n < count; ++n) {
    samples.push_back(std::sin(2 * pi * frequency * interval * static_cast<double>(n)));
  }
  return samples;
}

TEST(LowPass, LeavesTheShareOfItsFormulaAndNoPhase) {
  const double interval = 1e-4, cut = 400;
  for (const double frequency : {20.0, 200.0, 400.0, 800.0, 2400.0}) {
    const std::vector<double> samples = sine(frequency, interval, 4001);
    const std::vector<double> filtered = low_pass(samples, interval, cut);
    const double ratio = std::tan(pi * frequency * interval) / std::tan(pi * cut * interval);
    const double share = 1 / (1 + (std::sqrt(2.0) - 1) * std::pow(ratio, 4));
    for (std::size_t n = 1000; n < 3000; ++n) {
      ASSERT_NEAR(filtered[n], share * samples[n], 1e-9) << frequency << " Hz, sample " << n;
    }
  }
  const std::vector<double> at_cut = low_pass(sine(cut, interval, 4001), interval, cut);
  EXPECT_NEAR(*std::max_element(at_cut.begin() + 1000, at_cut.begin() + 3000), std::sqrt(0.5),
              2e-3);
}

TEST(LowPass, KeepsAConstantToTheEnds) {
  const std::vector<double> filtered = low_pass(std::vector<double>(500, 3.25), 1e-4, 40);
  for (const double value : filtered) EXPECT_EQ(value, 3.25);
  EXPECT_TRUE(low_pass({}, 1e-4, 40).empty());
  EXPECT_EQ(low_pass(std::vector<double>{2}, 1e-4, 40).size(), 1u);
}

/// A jump of the velocity by 1 m/s within one sample: the sampled peak is 1/interval, the filtered
/// one the integral of the filter's shares over the frequencies.
TEST(LowPass, PeakOfAnImpulseDoesNotKnowTheInterval) {
  const double cut = 400;
  const double exact = cut * pi / std::sqrt(2.0) / std::pow(std::sqrt(2.0) - 1, 0.25);
  const std::vector<std::pair<double, double>> allowed{
      {1e-6, 1e-3}, {1e-5, 1e-3}, {5e-5, 5e-3}, {1e-4, 0.015}, {2e-4, 0.05}};
  for (const auto& [interval, part] : allowed) {
    std::vector<double> samples(static_cast<std::size_t>(0.1 / interval), 0.0);
    samples[samples.size() / 2] = 1 / interval;
    const std::vector<double> filtered = low_pass(samples, interval, cut);
    EXPECT_NEAR(*std::ranges::max_element(filtered) / exact, 1, part) << interval;
  }
}

}  // namespace low_pass_test
}  // namespace pounding
