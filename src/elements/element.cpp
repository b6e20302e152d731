#include "elements/element.h"

#include <cstddef>
#include <stdexcept>
#include <string>

#include "elements/bar2.h"
#include "elements/beam2.h"
#include "elements/hex8.h"

namespace pounding {

namespace {

/// A wrong shape is a mistake of the program, not of the user.
void require_size(std::size_t found, int expected, const char* what) {
  if (found != static_cast<std::size_t>(expected))
    throw std::logic_error(std::string("element: size of ") + what + " is " +
                           std::to_string(found) + ", not " + std::to_string(expected));
}

void element_stiffness(ElementType type, std::span<const double> coordinates,
                       const ElementProperties& properties, std::span<double> stiffness) {
  switch (type) {
    case ElementType::hex8:
      return hex8_stiffness(coordinates, properties, Hex8Formulation::incompatible, stiffness);
    case ElementType::hex8_full:
      return hex8_stiffness(coordinates, properties, Hex8Formulation::full, stiffness);
    case ElementType::beam:
      return beam2_stiffness(coordinates, properties, stiffness);
    case ElementType::bar:
      return bar2_stiffness(coordinates, properties, stiffness);
  }
  throw std::logic_error("element_stiffness: unknown element type");
}

}  // namespace

ElementLayout element_layout(ElementType type) {
  switch (type) {
    case ElementType::hex8:
    case ElementType::hex8_full:
      return {8, 3};
    case ElementType::beam:
      return {2, 6};
    case ElementType::bar:
      return {2, 3};
  }
  throw std::logic_error("element_layout: unknown element type");
}

void element_matrices(ElementType type, std::span<const double> coordinates,
                      const ElementProperties& properties, std::span<double> stiffness,
                      std::span<double> lumped_mass) {
  const int size = element_layout(type).size();
  require_size(stiffness.size(), size * size, "stiffness");
  element_lumped_mass(type, coordinates, properties, lumped_mass);
  element_stiffness(type, coordinates, properties, stiffness);
}

void element_lumped_mass(ElementType type, std::span<const double> coordinates,
                         const ElementProperties& properties, std::span<double> lumped_mass) {
  const ElementLayout layout = element_layout(type);
  require_size(coordinates.size(), 3 * layout.nodes, "coordinates");
  require_size(lumped_mass.size(), layout.size(), "lumped_mass");
  switch (type) {
    case ElementType::hex8:
    case ElementType::hex8_full:
      return hex8_lumped_mass(coordinates, properties, lumped_mass);
    case ElementType::beam:
      return beam2_lumped_mass(coordinates, properties, lumped_mass);
    case ElementType::bar:
      return bar2_lumped_mass(coordinates, properties, lumped_mass);
  }
}

}  // namespace pounding
