#include "motion/spectrum_shape.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "motion_files.h"

namespace pounding {
namespace spectrum_shape_test {

TEST(SpectrumShape, RegulatoryFrequencies) {
  const auto f = regulatory_frequencies();
  ASSERT_EQ(f.size(), 75u);
  EXPECT_EQ(f.front(), 0.2);
  EXPECT_EQ(f[28], 3.0);
  EXPECT_EQ(f[29], 3.15);
  EXPECT_EQ(f[32], 3.6);
  EXPECT_EQ(f[39], 5.0);
  EXPECT_EQ(f[51], 8.0);
  EXPECT_EQ(f[65], 15.0);
  EXPECT_EQ(f[68], 18.0);
  EXPECT_EQ(f[70], 22.0);
  EXPECT_EQ(f.back(), 34.0);
}

TEST(SpectrumShape, EnvelopeTakesTheLargestOfEach) {
  const std::vector<std::vector<double>> spectra{{1, 5, 2}, {3, 4, 2}, {2, 0, 7}};
  EXPECT_THAT(envelope_of(spectra), ::testing::ElementsAre(3, 5, 7));
}

TEST(SpectrumShape, BroadeningWidensAPeakToBothSides) {
  std::vector<double> f, s;
  for (int i = 0; i <= 400; ++i) {
    f.push_back(std::pow(10, i / 200.0 - 1));  // 0.1 to 10 Hz
    s.push_back(i == 200 ? 9 : 1);             // a peak at 1 Hz
  }
  const auto wide = broadened(f, s, 0.15);
  for (std::size_t i = 0; i < f.size(); ++i) {
    // f / 1.15 <= 1 <= f / 0.85 holds the peak; its flanks reach one spacing further.
    const double spacing = f[1] / f[0];
    if (f[i] >= 0.85 && f[i] <= 1.15)
      EXPECT_EQ(wide[i], 9) << f[i];
    else if (f[i] < 0.85 / spacing || f[i] > 1.15 * spacing)
      EXPECT_EQ(wide[i], 1) << f[i];
    else
      EXPECT_GE(wide[i], 1) << f[i];
  }
}

TEST(SpectrumShape, BroadeningOfAPowerIsThePowerAtTheEdge) {
  // Log-log lines are exact: of f^2 the largest within the band is at f / (1 - 0.15).
  const std::vector<double> f{1, 2, 5, 11, 30};
  std::vector<double> s;
  for (const double x : f) s.push_back(x * x);
  const auto wide = broadened(f, s, 0.15);
  for (std::size_t i = 0; i + 1 < f.size(); ++i)
    EXPECT_NEAR(wide[i] / (s[i] / (0.85 * 0.85)), 1, 1e-14);
  EXPECT_EQ(wide.back(), s.back());  // nothing is known beyond
}

TEST(SpectrumShape, BroadeningOfZerosAndByNothing) {
  const std::vector<double> f{1, 2, 3}, zero{0, 0, 0}, s{1, 0, 4};
  EXPECT_EQ(broadened(f, zero, 0.15), zero);
  EXPECT_EQ(broadened(f, s, 0), s);
  for (const double value : broadened(f, s, 0.15)) EXPECT_TRUE(std::isfinite(value));
}

TEST(SpectrumShape, RefusesABroadeningOutOfRange) {
  const std::vector<double> f{1, 2}, s{1, 1};
  for (const double fraction : {-0.1, 1.0, 15.0, std::nan("")})
    EXPECT_THAT(testing_support::refusal([&] { broadened(f, s, fraction); }),
                ::testing::HasSubstr("broadening"));
}

}  // namespace spectrum_shape_test
}  // namespace pounding
