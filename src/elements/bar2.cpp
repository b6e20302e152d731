#include "elements/bar2.h"

#include <algorithm>
#include <cstddef>

#include "elements/local_frame.h"
#include "elements/symmetric_matrix.h"

namespace pounding {

void bar2_stiffness(std::span<const double> coordinates, const ElementProperties& properties,
                    std::span<double> stiffness) {
  constexpr std::size_t size = 6;
  const auto [direction, length] = segment_between(coordinates);
  const double k = properties.young * properties.area / length;
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const double sign = (i < 3) == (j < 3) ? 1.0 : -1.0;
      stiffness[i * size + j] = sign * k * direction[i % 3] * direction[j % 3];
    }
  }
  mirror_lower_triangle(stiffness, size);
}

void bar2_lumped_mass(std::span<const double> coordinates, const ElementProperties& properties,
                      std::span<double> lumped_mass) {
  const double length = segment_between(coordinates).length;
  std::fill(lumped_mass.begin(), lumped_mass.end(),
            (properties.density * properties.area + properties.added_mass) * length / 2);
}

}  // namespace pounding
