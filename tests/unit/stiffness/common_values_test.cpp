#include <array>

#include <gtest/gtest.h>

#include "stiffness/element_shapes.h"

namespace pounding::stiffness {
namespace common_values_test {

TEST(CommonValues, AreTheMiddleOfThoseThatBelongTogether) {
  CommonValues values(1e-10);
  for (const double value : {0.25, 0.3 + 2e-11, 0.25 + 4e-11, 0.3, 0.25 - 4e-11, -0.25}) {
    values.add(value);
  }
  values.agree(MPI_COMM_SELF);
  EXPECT_DOUBLE_EQ(values(0.25 + 4e-11), 0.25);
  EXPECT_EQ(values(0.25), values(0.25 - 4e-11));
  EXPECT_DOUBLE_EQ(values(0.3), 0.3 + 1e-11);
  EXPECT_EQ(values(-0.25), -0.25);
}

/// Whatever the order: a value between two ranges makes them one.
TEST(CommonValues, ChainsBelongTogether) {
  for (const auto& order : {std::array<double, 3>{1, 2, 3}, {1, 3, 2}, {3, 2, 1}}) {
    CommonValues values(1.5);
    for (const double value : order) values.add(value);
    values.agree(MPI_COMM_SELF);
    EXPECT_EQ(values(1), 2);
    EXPECT_EQ(values(3), 2);
  }
}

TEST(CommonValues, TooManyAreRounded) {
  CommonValues values(1e-6);
  for (int i = 0; i < 20000; ++i) values.add(i * 1e-3 + 2e-7);
  values.agree(MPI_COMM_SELF);
  EXPECT_DOUBLE_EQ(values(5e-3 + 2e-7), 5e-3);
  EXPECT_EQ(values(5e-3 + 2e-7), values(5e-3 - 2e-7));
}

}  // namespace common_values_test
}  // namespace pounding::stiffness
