#include "elements/point.h"

#include <algorithm>

namespace pounding {

void point_lumped_mass(const ElementProperties& properties, std::span<double> lumped_mass) {
  for (std::size_t i = 0; i < lumped_mass.size(); ++i) {
    lumped_mass[i] = i < 3 ? properties.mass : properties.rotary_inertia[i - 3];
  }
}

void spring_matrix(const ElementLayout& layout, const std::array<double, 6>& values,
                   std::span<double> matrix) {
  std::fill(matrix.begin(), matrix.end(), 0.0);
  const std::size_t components = layout.components;
  const std::size_t size = layout.size();
  for (std::size_t c = 0; c < components; ++c) {
    for (std::size_t i = c; i < size; i += components) {
      for (std::size_t j = c; j < size; j += components) {
        matrix[i * size + j] = i == j ? values[c] : -values[c];
      }
    }
  }
}

}  // namespace pounding
