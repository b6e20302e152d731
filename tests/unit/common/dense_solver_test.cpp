#include <random>

#include <gtest/gtest.h>

#include "common/dense_matrix.h"

namespace pounding {
namespace dense_solver_test {

TEST(DenseSolver, InvertsDefiniteMatrices) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  constexpr std::size_t n = 7;
  std::vector<double> factor(n * n);
  for (double& value : factor) value = normal(random);
  std::vector<double> matrix(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    matrix[i * n + i] = 0.5;
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t k = 0; k < n; ++k) {
        matrix[i * n + j] += factor[i * n + k] * factor[j * n + k];
      }
    }
  }
  std::vector<double> inverse = matrix;
  ASSERT_TRUE(invert_definite(inverse));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < n; ++k) sum += matrix[i * n + k] * inverse[k * n + j];
      EXPECT_NEAR(sum, i == j ? 1 : 0, 1e-12) << i << " " << j;
      EXPECT_EQ(inverse[i * n + j], inverse[j * n + i]);
    }
  }
}

TEST(DenseSolver, SaysThatAMatrixIsNotDefinite) {
  std::vector<double> matrix{1, 2, 2, 1};
  EXPECT_FALSE(invert_definite(matrix));
}

}  // namespace dense_solver_test
}  // namespace pounding
