#include "elements/symmetric_matrix.h"

#include <cstddef>
#include <sstream>

#include "elements/element_properties.h"

namespace pounding {

void mirror_lower_triangle(std::span<double> matrix, int size) {
  const std::size_t n = size;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) matrix[j * n + i] = matrix[i * n + j];
  }
}

void condense_last(std::span<double> matrix, int size, int kept, std::span<double> condensed) {
  const std::size_t n = size;
  const std::size_t m = kept;
  // Gaussian elimination from the last dof backwards; symmetric, so it needs no pivoting.
  for (std::size_t p = n; p-- > m;) {
    const double pivot = matrix[p * n + p];
    if (!(pivot > 0)) {
      std::ostringstream message;
      message << "internal modes without stiffness (pivot " << pivot
              << "); check young and poisson";
      throw ElementError(message.str());
    }
    for (std::size_t i = 0; i < p; ++i) {
      const double factor = matrix[p * n + i] / pivot;
      for (std::size_t j = 0; j <= i; ++j) matrix[i * n + j] -= factor * matrix[p * n + j];
    }
  }
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t j = 0; j <= i; ++j) condensed[i * m + j] = matrix[i * n + j];
  }
  mirror_lower_triangle(condensed, kept);
}

}  // namespace pounding
