#include "elements/element.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "elements/point.h"

namespace pounding {

namespace {

/// A wrong shape is a mistake of the program, not of the user.
void require_size(std::size_t found, int expected, const char* what) {
  if (found != static_cast<std::size_t>(expected)) {
    throw std::logic_error(std::string("element: size of ") + what + " is " +
                           std::to_string(found) + ", not " + std::to_string(expected));
  }
}

}  // namespace

ElementLayout element_layout(ElementType type) {
  return traits_of(type).layout;
}

void element_matrices(ElementType type, std::span<const double> coordinates,
                      const ElementProperties& properties, std::span<double> stiffness,
                      std::span<double> lumped_mass) {
  const int size = element_layout(type).size();
  require_size(stiffness.size(), size * size, "stiffness");
  element_lumped_mass(type, coordinates, properties, lumped_mass);
  traits_of(type).stiffness(coordinates, properties, stiffness);
}

void element_lumped_mass(ElementType type, std::span<const double> coordinates,
                         const ElementProperties& properties, std::span<double> lumped_mass) {
  const ElementLayout layout = element_layout(type);
  require_size(coordinates.size(), 3 * layout.nodes, "coordinates");
  require_size(lumped_mass.size(), layout.size(), "lumped_mass");
  traits_of(type).lumped_mass(coordinates, properties, lumped_mass);
}

void element_dashpots(ElementType type, const ElementProperties& properties,
                      std::span<double> damping) {
  const ElementLayout layout = element_layout(type);
  require_size(damping.size(), layout.size() * layout.size(), "damping");
  if (type == ElementType::soil) {
    ground_spring_matrix(properties.ground_springs, &GroundSpring::dashpot, damping);
  } else if (is_spring(type)) {
    spring_matrix(layout, properties.dashpot, damping);
  } else {
    std::ranges::fill(damping, 0.0);
  }
}

}  // namespace pounding
