#include "stiffness/single_stiffness.h"

#include "elements/local_frame.h"
#include "stiffness/element_shapes.h"
#include "stiffness/strains/single_hexahedron.h"

namespace pounding::stiffness {

bool may_round(ElementType type, std::span<const double> coordinates) {
  return traits_of(type).kernel == ElementKernel::brick &&
         !ElementFrames::axes_of_box(coordinates, congruence) && !Extrusion::find(coordinates);
}

void element_matrices_in(Numbers numbers_kept, ElementType type,
                         std::span<const double> coordinates, const ElementProperties& properties,
                         std::span<double> stiffness, std::span<double> lumped_mass) {
  element_matrices(type, coordinates, properties, stiffness, lumped_mass);
  if (numbers_kept == Numbers::in_double || !may_round(type, coordinates)) return;
  const auto numbers = SingleHexahedron::find(coordinates, stiffness);
  if (!numbers) return;
  constexpr std::size_t size = SingleHexahedron::size;
  // Unit displacements side by side.
  for (std::size_t first = 0; first < size; first += element_lane_count) {
    ElementLanes values[size] = {};
    for (std::size_t lane = 0; lane < element_lane_count; ++lane) values[first + lane][lane] = 1;
    SingleHexahedron::product(NumbersOfOne<float>{numbers->data()}, values);
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t lane = 0; lane < element_lane_count; ++lane) {
        stiffness[i * size + first + lane] = values[i][lane];
      }
    }
  }
  mirror_lower_triangle(stiffness, static_cast<int>(size));
}

}  // namespace pounding::stiffness
