#include "interactions/pairing/gap_field.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace pounding::interactions {
namespace gap_field_test {

Contact joint(double deviation, double length, int seed, const std::string& name = "floor") {
  Contact contact;
  contact.name = name;
  contact.gap = {{0.05}, deviation, length, seed};
  return contact;
}

/// Points of a square face, apart by a length of correlation.
std::vector<std::array<double, 2>> square(int side, double length) {
  std::vector<std::array<double, 2>> places;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) places.push_back({i * length + 7, j * length - 3});
  }
  return places;
}

TEST(GapField, NothingWithoutADeviation) {
  EXPECT_EQ(GapField(joint(0, 1, 1)).at({3, 4}), 0);
}

TEST(GapField, SeedAndNameDetermineIt) {
  const double value = GapField(joint(0.005, 2, 4)).at({1, 2});
  EXPECT_EQ(value, GapField(joint(0.005, 2, 4)).at({1, 2}));
  EXPECT_NE(value, GapField(joint(0.005, 2, 5)).at({1, 2}));
  EXPECT_NE(value, GapField(joint(0.005, 2, 4, "roof")).at({1, 2}));
  EXPECT_DOUBLE_EQ(2 * value, GapField(joint(0.010, 2, 4)).at({1, 2}));
  EXPECT_NEAR(value, GapField(joint(0.005, 4, 4)).at({2, 4}), 1e-15);  // in parts of the length
}

/// Mean and variance over a face of 20 x 20 lengths, in 100 seeds: within twice their standard
/// errors, which follow from the covariance itself, in at least 95 (98 more often than not).
TEST(GapField, MeanAndDeviationOverAFaceAreThoseOfTheory) {
  const double deviation = 0.008, length = 1.5;
  const auto places = square(20, length);
  const auto count = static_cast<double>(places.size());
  double mean_variance = 0, square_variance = 0;  // in parts of deviation^2 and its square
  for (const auto& a : places) {
    for (const auto& b : places) {
      const double covariance = std::exp(-std::hypot(a[0] - b[0], a[1] - b[1]) / length);
      mean_variance += covariance / (count * count);
      square_variance += 2 * covariance * covariance / (count * count);
    }
  }
  int mean_agrees = 0, square_agrees = 0;
  for (int seed = 1; seed <= 100; ++seed) {
    const GapField field(joint(deviation, length, seed));
    double mean = 0, square = 0;
    for (const auto& place : places) {
      const double value = field.at(place) / deviation;
      mean += value / count;
      square += value * value / count;
    }
    mean_agrees += std::abs(mean) < 2.2 * std::sqrt(mean_variance) ? 1 : 0;
    square_agrees += std::abs(square - 1) < 2.2 * std::sqrt(square_variance) ? 1 : 0;
  }
  EXPECT_GE(mean_agrees, 95);
  EXPECT_GE(square_agrees, 95);
}

/// Products of values at two places over 2,000 seeds, at distances along both axes and across.
TEST(GapField, CovarianceFallsWithTheDistance) {
  const double length = 3;
  const std::vector<std::array<double, 2>> places{{0, 0}, {1.5, 0}, {0, 3}, {2.4, 3.2}, {-9, 0}};
  std::vector<double> products(places.size(), 0.0), squares(places.size(), 0.0);
  const int seeds = 2000;
  for (int seed = 1; seed <= seeds; ++seed) {
    const GapField field(joint(1, length, seed));
    const double first = field.at(places[0]);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double product = first * field.at(places[i]);
      products[i] += product / seeds;
      squares[i] += product * product / seeds;
    }
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double expected = std::exp(-std::hypot(places[i][0], places[i][1]) / length);
    const double error = std::sqrt((squares[i] - products[i] * products[i]) / seeds);
    EXPECT_NEAR(products[i], expected, 3 * error) << i;
    EXPECT_LT(error, 0.05);
  }
}

}  // namespace gap_field_test
}  // namespace pounding::interactions
