#include "system/yielding_shells.h"

#include <utility>
#include <vector>

#include "elements/shell_forces.h"
#include "system/each_element.h"
#include "system/motion_laws.h"

namespace pounding {
namespace {

/// The mean shear strain of a shell, under a law of stress over strain.
LawMotion shear_motion(ElementType type, std::span<const double> coordinates,
                       const ElementProperties& properties,
                       std::shared_ptr<const interactions::HystereticLaw> law) {
  constexpr std::size_t g12 = 2;
  const double volume = shell_area(type, coordinates) * properties.thickness;
  const std::vector<double> strains = shell_strain_rows(type, coordinates, properties);
  const auto size = static_cast<std::ptrdiff_t>(element_layout(type).size());
  const auto begin = strains.begin() + g12 * size;
  return {std::vector<double>(begin, begin + size), std::move(law), volume};
}

}  // namespace

std::shared_ptr<interactions::ElementLaw> yielding_shells(const Structure& structure,
                                                          const Mesh& mesh, int region) {
  const Region& own = structure.regions[static_cast<std::size_t>(region)];
  const Hysteresis* const law = &*own.yielding_shell.shear;
  auto shells = std::make_shared<MotionLaws>(std::vector<std::string>{"shear"},
                                             std::span<const Hysteresis* const>(&law, 1));
  const auto shear = std::make_shared<const interactions::HystereticLaw>(*law);
  const ElementProperties properties = element_properties(own);
  stiffness::ElementWork coordinates;
  for_each_element_of(
      structure, mesh, region,
      [&](const ElementBlock& block, std::size_t e, const ElementLayout&,
          const stiffness::ElementWork&) {
        std::vector<LawMotion> motion;
        motion.push_back(shear_motion(block.type, gather_coordinates(mesh, block, e, coordinates),
                                      properties, shear));
        shells->add(std::move(motion));
      });
  return shells;
}

}  // namespace pounding
