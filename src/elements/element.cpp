#include "elements/element.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "elements/bar2.h"
#include "elements/beam2.h"
#include "elements/hex8.h"
#include "elements/point.h"
#include "elements/shell3.h"
#include "elements/shell4.h"

namespace pounding {

namespace {

/// A wrong shape is a mistake of the program, not of the user.
void require_size(std::size_t found, int expected, const char* what) {
  if (found != static_cast<std::size_t>(expected))
    throw std::logic_error(std::string("element: size of ") + what + " is " +
                           std::to_string(found) + ", not " + std::to_string(expected));
}

ShellProperties shell_properties(const ElementProperties& p) {
  return {p.young, p.poisson, p.density, p.thickness, p.rotary_inertia_factor};
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
    case ElementType::tension_bar:
      return bar2_stiffness(coordinates, properties, stiffness);
    case ElementType::shell4:
      return shell4_stiffness(coordinates, shell_properties(properties), stiffness);
    case ElementType::shell3:
      return shell3_stiffness(coordinates, shell_properties(properties), stiffness);
    case ElementType::point_mass:
    case ElementType::point_mass6:
      std::fill(stiffness.begin(), stiffness.end(), 0.0);
      return;
    case ElementType::grounded_spring:
    case ElementType::grounded_spring6:
    case ElementType::spring:
    case ElementType::spring6:
      return spring_matrix(element_layout(type), properties.stiffness, stiffness);
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
    case ElementType::tension_bar:
    case ElementType::spring:
      return {2, 3};
    case ElementType::spring6:
      return {2, 6};
    case ElementType::shell4:
      return {4, 6};
    case ElementType::shell3:
      return {3, 6};
    case ElementType::point_mass:
    case ElementType::grounded_spring:
      return {1, 3};
    case ElementType::point_mass6:
    case ElementType::grounded_spring6:
      return {1, 6};
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
    case ElementType::tension_bar:
      return bar2_lumped_mass(coordinates, properties, lumped_mass);
    case ElementType::shell4:
      return shell4_lumped_mass(coordinates, shell_properties(properties), lumped_mass);
    case ElementType::shell3:
      return shell3_lumped_mass(coordinates, shell_properties(properties), lumped_mass);
    case ElementType::point_mass:
    case ElementType::point_mass6:
      return point_lumped_mass(properties, lumped_mass);
    case ElementType::grounded_spring:
    case ElementType::grounded_spring6:
    case ElementType::spring:
    case ElementType::spring6:
      std::fill(lumped_mass.begin(), lumped_mass.end(), 0.0);
      return;
  }
}

void element_dashpots(ElementType type, const ElementProperties& properties,
                      std::span<double> damping) {
  const ElementLayout layout = element_layout(type);
  require_size(damping.size(), layout.size() * layout.size(), "damping");
  switch (type) {
    case ElementType::grounded_spring:
    case ElementType::grounded_spring6:
    case ElementType::spring:
    case ElementType::spring6:
      return spring_matrix(layout, properties.dashpot, damping);
    default:
      std::fill(damping.begin(), damping.end(), 0.0);
  }
}

}  // namespace pounding
