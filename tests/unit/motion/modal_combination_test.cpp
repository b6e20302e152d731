#include "motion/modal_combination.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace pounding {
namespace modal_combination_test {

TEST(ModalCorrelation, IsThatOfTheTables) {
  // 5 % damping, ratios of the frequencies .9, .8, .7, .6, as printed for the CQC method.
  EXPECT_NEAR(modal_correlation(1, 0.05, 0.9, 0.05), 0.473, 0.001);
  EXPECT_NEAR(modal_correlation(1, 0.05, 0.8, 0.05), 0.166, 0.001);
  EXPECT_NEAR(modal_correlation(1, 0.05, 0.7, 0.05), 0.071, 0.001);
  EXPECT_NEAR(modal_correlation(1, 0.05, 0.6, 0.05), 0.035, 0.001);
}

TEST(ModalCorrelation, IsSymmetricAndOneForTwoAlike) {
  EXPECT_EQ(modal_correlation(2, 0.05, 2, 0.05), 1);
  EXPECT_EQ(modal_correlation(2, 0, 2, 0), 1);
  EXPECT_EQ(modal_correlation(2, 0, 3, 0), 0);
  EXPECT_EQ(modal_correlation(0, 0.05, 3, 0.05), 0);
  EXPECT_NEAR(modal_correlation(2, 0.02, 3, 0.1), modal_correlation(3, 0.1, 2, 0.02), 1e-15);
  EXPECT_LT(modal_correlation(2, 0.02, 2, 0.1), 1);
  EXPECT_NE(modal_correlation(2, 0.02, 3, 0.1), modal_correlation(2, 0.1, 3, 0.02));
}

TEST(ModalCorrelations, CombineSumsAndDifferences) {
  const ModalCorrelations same(std::vector<double>{2, 2}, std::vector<double>{0.05, 0.05});
  EXPECT_DOUBLE_EQ(same.combined(std::vector<double>{3, 4}, 0, 2), 7);
  EXPECT_DOUBLE_EQ(same.combined(std::vector<double>{3, -4}, 0, 2), 1);
  EXPECT_DOUBLE_EQ(same.combined(std::vector<double>{3, -4}, 1, 2), 4);
  EXPECT_EQ(same.combined(std::vector<double>{3, -4}, 2, 2), 0);
  const ModalCorrelations apart(std::vector<double>{1, 1000}, std::vector<double>{0.01, 0.01});
  EXPECT_NEAR(apart.combined(std::vector<double>{3, 4}, 0, 2), 5, 1e-6);
}

}  // namespace modal_combination_test
}  // namespace pounding
