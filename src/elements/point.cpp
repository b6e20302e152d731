#include "elements/point.h"

#include <algorithm>

#include "common/matrix3.h"

namespace pounding {

void point_lumped_mass(const ElementProperties& properties, std::span<double> lumped_mass) {
  for (std::size_t i = 0; i < lumped_mass.size(); ++i) {
    lumped_mass[i] =
        i < 3 ? properties.mass * properties.mass_along[i] : properties.rotary_inertia[i - 3];
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

std::array<std::array<double, 6>, 6> motion_at(const Vector3& arm) {
  std::array<std::array<double, 6>, 6> motion{};
  for (std::size_t c = 0; c < 6; ++c) motion[c] = rigid_motion_row(c, arm);
  return motion;
}

void ground_spring_matrix(std::span<const GroundSpring> springs, double GroundSpring::*value,
                          std::span<double> matrix) {
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      double sum = 0;
      for (const GroundSpring& spring : springs) {
        sum += spring.*value * (spring.motion[i] * spring.motion[j]);
      }
      matrix[6 * i + j] = sum;
    }
  }
}

}  // namespace pounding
