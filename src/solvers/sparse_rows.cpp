#include "solvers/sparse_rows.h"

namespace pounding::interactions {

void take_principal_part(const SparseRows& whole, std::span<const int> number, SparseRows& part) {
  part.clear();
  for (std::size_t row = 0; row < whole.rows(); ++row) {
    if (number[row] < 0) continue;
    for (std::size_t k = whole.begin[row]; k < whole.begin[row + 1]; ++k) {
      const int column = number[static_cast<std::size_t>(whole.column[k])];
      if (column >= 0) part.add(column, whole.value[k]);
    }
    part.end_row();
  }
}

}  // namespace pounding::interactions
