#include "common/dense_matrix.h"

#include <cmath>

#include <gtest/gtest.h>

namespace pounding {
namespace dense_matrix_test {

DenseMatrix waves(std::size_t rows, std::size_t columns) {
  DenseMatrix matrix(rows, columns);
  for (std::size_t k = 0; k < matrix.values.size(); ++k) {
    matrix.values[k] = std::sin(0.7 * static_cast<double>(k) + static_cast<double>(columns));
  }
  return matrix;
}

TEST(DenseMatrix, ColumnsCombineInTheirPlace) {
  for (const std::size_t rows : {1, 4095, 4096, 9001}) {
    for (const std::size_t columns : {0, 1, 5, 12}) {
      const DenseMatrix before = waves(rows, 12);
      const DenseMatrix by = waves(12, columns);
      DenseMatrix expected(rows, columns);
      add_product(1, before, by, expected);
      DenseMatrix matrix = before;
      combine_columns(matrix, by);
      ASSERT_EQ(matrix.columns, columns);
      ASSERT_EQ(matrix.values.size(), rows * columns);
      for (std::size_t k = 0; k < expected.values.size(); ++k) {
        ASSERT_NEAR(matrix.values[k], expected.values[k], 1e-13) << rows << " " << k;
      }
    }
  }
}

TEST(DenseMatrix, ColumnsAreAddedAndTakenOut) {
  DenseMatrix matrix(3, 0);
  for (const double value : {1.0, 2.0, 3.0}) matrix.append(std::vector<double>{value, -value, 0});
  DenseMatrix more(3, 0);
  more.append_columns(matrix);
  more.remove(0);
  EXPECT_EQ(more.numbers(), (std::vector<double>{3, -3, 0, 2, -2, 0}));
}

}  // namespace dense_matrix_test
}  // namespace pounding
