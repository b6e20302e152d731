#include "elements/element_traits.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "elements/beam2.h"
#include "elements/flat_shell.h"
#include "elements/measured_costs.h"
#include "elements/point.h"
#include "elements/solids.h"

namespace pounding {
namespace {

using Coordinates = std::span<const double>;
using Matrix = std::span<double>;
using Family = ElementFamily;
using Kernel = ElementKernel;
using Properties = ElementProperties;
using Type = ElementType;

template <Hex8Formulation formulation>
void brick_stiffness(Coordinates coordinates, const Properties& properties, Matrix stiffness) {
  hex8_stiffness(coordinates, properties, formulation, stiffness);
}

using ShellFunction = void (*)(Coordinates, const ShellProperties&, Matrix);

template <ShellFunction function>
void of_shell(Coordinates coordinates, const Properties& p, Matrix result) {
  function(coordinates,
           {p.young, p.poisson, p.density, p.thickness, p.rotary_inertia_factor, p.added_mass,
            p.drilling_factor},
           result);
}

template <int nodes, int components>
void spring_stiffness(Coordinates, const Properties& properties, Matrix stiffness) {
  spring_matrix({nodes, components}, properties.stiffness, stiffness);
}

void soil_stiffness(Coordinates, const Properties& properties, Matrix stiffness) {
  ground_spring_matrix(properties.ground_springs, &GroundSpring::stiffness, stiffness);
}

void point_mass(Coordinates, const Properties& properties, Matrix lumped_mass) {
  point_lumped_mass(properties, lumped_mass);
}

void nothing(Coordinates, const Properties&, Matrix result) {
  std::ranges::fill(result, 0.0);
}

// clang-format off
constexpr std::array table{
    // type, name, word of the option, family, nodes and components, type in Gmsh, companion, faces,
    //   stiffness, lumped mass, kernel, cost, linear, scalable, caution
    ElementTraits{Type::hex8, "hex8", "hex8", Family::solid, {8, 3}, 5, Type::wedge6, hex8_faces,
        brick_stiffness<Hex8Formulation::incompatible>, hex8_lumped_mass, Kernel::brick, measured_costs::brick, true, true},
    ElementTraits{Type::hex8_full, "hex8_full", "hex8_full", Family::solid, {8, 3}, 5, Type::wedge6, hex8_faces,
        brick_stiffness<Hex8Formulation::full>, hex8_lumped_mass, Kernel::brick, measured_costs::brick, true, true},
    ElementTraits{Type::beam, "beam", "beam", Family::beam, {2, 6}, 1, {}, {},
        beam2_stiffness, beam2_lumped_mass, Kernel::beam, measured_costs::beam, true, true},
    ElementTraits{Type::euler_beam, "euler_beam", "euler_beam", Family::beam, {2, 6}, 1, {}, {},
        beam2_stiffness, euler_beam_lumped_mass, Kernel::beam, measured_costs::beam, true, true},
    ElementTraits{Type::bar, "bar", "bar", Family::bar, {2, 3}, 1, {}, {},
        bar2_stiffness, bar2_lumped_mass, Kernel::sparse, measured_costs::small, true, true},
    ElementTraits{Type::tension_bar, "bar (one way)", "bar", Family::bar, {2, 3}, 1, {}, {},
        bar2_stiffness, bar2_lumped_mass, Kernel::sparse, measured_costs::small, false, false},
    ElementTraits{Type::shell4, "shell4", "shell", Family::shell, {4, 6}, 3, Type::shell3, {},
        of_shell<shell4_stiffness>, of_shell<shell4_lumped_mass>, Kernel::rectangle, measured_costs::rectangle, true, true},
    ElementTraits{Type::shell3, "shell3", "shell", Family::shell, {3, 6}, 2, {}, {},
        of_shell<shell3_stiffness>, of_shell<shell3_lumped_mass>, Kernel::triangle, measured_costs::triangle, true, true},
    ElementTraits{Type::point_mass, "point_mass", "point_mass", Family::point_mass, {1, 3}, 15, {}, {},
        nothing, point_mass, Kernel::sparse, measured_costs::small, true, false},
    ElementTraits{Type::point_mass6, "point_mass", "point_mass", Family::point_mass, {1, 6}, 15, {}, {},
        nothing, point_mass, Kernel::sparse, measured_costs::small, true, false},
    ElementTraits{Type::grounded_spring, "grounded_spring", "grounded_spring", Family::grounded_spring, {1, 3}, 15, {}, {},
        spring_stiffness<1, 3>, nothing, Kernel::sparse, measured_costs::small, true, true},
    ElementTraits{Type::grounded_spring6, "grounded_spring", "grounded_spring", Family::grounded_spring, {1, 6}, 15, {}, {},
        spring_stiffness<1, 6>, nothing, Kernel::sparse, measured_costs::small, true, true},
    ElementTraits{Type::spring, "spring", "spring", Family::spring, {2, 3}, 1, {}, {},
        spring_stiffness<2, 3>, nothing, Kernel::sparse, measured_costs::small, true, true},
    ElementTraits{Type::spring6, "spring", "spring", Family::spring, {2, 6}, 1, {}, {},
        spring_stiffness<2, 6>, nothing, Kernel::sparse, measured_costs::small, true, true},
    ElementTraits{Type::wedge6, "wedge6", "wedge6", Family::solid, {6, 3}, 6, {}, wedge6_faces,
        wedge6_stiffness, wedge6_lumped_mass, Kernel::sparse, measured_costs::sparse_wedge6, true, true},
    ElementTraits{Type::tet4, "tet4", "tet4", Family::solid, {4, 3}, 4, {}, tet4_faces,
        tet4_stiffness, tet4_lumped_mass, Kernel::sparse, measured_costs::sparse_tet4, true, true,
        "linear tetrahedra are too stiff in bending and lock near poisson 0.5; prefer wedge6 or hex8"},
    ElementTraits{Type::soil, "soil", "grounded_spring", Family::grounded_spring, {1, 6}, 15, {}, {},
        soil_stiffness, nothing, Kernel::sparse, measured_costs::small, true, false},
    ElementTraits{Type::yielding_bar, "bar (yields)", "bar", Family::bar, {2, 3}, 1, {}, {},
        bar2_stiffness, bar2_lumped_mass, Kernel::sparse, measured_costs::small, false, false}};
// clang-format on

/// Whether `list`, split at '|', has an entry `word`.
constexpr bool contains_word(std::string_view list, std::string_view word) {
  while (true) {
    const std::size_t end = list.find('|');
    if (list.substr(0, end) == word) return true;
    if (end == std::string_view::npos) return false;
    list.remove_prefix(end + 1);
  }
}

constexpr bool table_is_sound() {
  std::size_t place = 0;
  return std::ranges::all_of(table, [&](const ElementTraits& row) {
    return row.type == static_cast<ElementType>(place++) && row.layout.nodes <= max_element_nodes &&
           row.layout.size() <= max_element_size &&
           row.faces.empty() == (row.family != ElementFamily::solid) &&
           contains_word(element_words, row.option);
  });
}

/// Whether every word of the option is one of the table's.
constexpr bool words_have_rows() {
  std::string_view left = element_words;
  while (true) {
    const std::size_t end = left.find('|');
    if (std::ranges::find(table, left.substr(0, end), &ElementTraits::option) == table.end()) {
      return false;
    }
    if (end == std::string_view::npos) return true;
    left.remove_prefix(end + 1);
  }
}

static_assert(table_is_sound(), "rows in the order of the types, their words in element_words");
static_assert(words_have_rows(), "a word of element_words has no row");

/// A wrong shape is a mistake of the program, not of the user.
void require_size(std::size_t found, int expected, const char* what) {
  if (found != static_cast<std::size_t>(expected)) {
    throw std::logic_error(std::string("element: size of ") + what + " is " +
                           std::to_string(found) + ", not " + std::to_string(expected));
  }
}

}  // namespace

const ElementTraits& traits_of(ElementType type) {
  return table.at(static_cast<std::size_t>(type));
}

ElementType element_of_word(std::string_view word) {
  const auto row = std::ranges::find(table, word, &ElementTraits::option);
  if (row == table.end()) throw std::logic_error("no element has the word " + std::string(word));
  return row->type;
}

int shared_by_neighbours(ElementType type) {
  int fewest = max_element_nodes;
  for (const ElementFace& face : traits_of(type).faces) fewest = std::min(fewest, face.count);
  return is_solid(type) ? fewest : 1;
}

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

void element_dashpots(ElementType type, std::span<const double> coordinates,
                      const ElementProperties& properties, std::span<double> damping) {
  const ElementLayout layout = element_layout(type);
  require_size(damping.size(), layout.size() * layout.size(), "damping");
  if (type == ElementType::soil) {
    ground_spring_matrix(properties.ground_springs, &GroundSpring::dashpot, damping);
  } else if (is_spring(type)) {
    spring_matrix(layout, properties.dashpot, damping);
  } else if (is_bar(type)) {
    bar2_matrix(coordinates, properties.dashpot[0], damping);
  } else {
    std::ranges::fill(damping, 0.0);
  }
}

}  // namespace pounding
