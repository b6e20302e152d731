#include "mesh/element_properties.h"

namespace pounding {

ElementProperties element_properties(const Region& region, double share) {
  ElementProperties properties;
  properties.young = region.material.young;
  properties.poisson = region.material.poisson;
  properties.density = region.material.density;
  properties.area = region.area;
  properties.thickness = region.thickness;
  properties.rotary_inertia_factor = region.rotary_inertia_factor;
  properties.drilling_factor = region.drilling_factor;
  properties.added_mass = region.added_mass;
  properties.mass = share * region.mass;
  properties.mass_along = region.mass_along;
  properties.rotary_inertia = region.rotary_inertia;
  for (std::size_t c = 0; c < region.stiffness.size(); ++c) {
    properties.stiffness[c] = share * region.stiffness[c];
    // One in series with a spring is no damping matrix.
    const bool series = region.nonlinear.dashpot_stiffness[c] > 0;
    properties.dashpot[c] = series ? 0 : share * region.dashpot[c];
  }
  if (region.foundation) properties.ground_springs = region.foundation->springs;
  for (std::size_t c = 0; is_spring(region.element) && c < properties.stiffness.size(); ++c) {
    if (region.nonlinear.yields(c)) properties.stiffness[c] = 0;  // a law holds it
  }
  if (region.compression_only) properties.stiffness[2] = properties.dashpot[2] = 0;
  if (region.section) {
    properties.area = region.section->area;
    properties.inertia_y = region.section->inertia_y;
    properties.inertia_z = region.section->inertia_z;
    properties.torsion = region.section->torsion;
    properties.z_axis = region.section->z_axis;
    if (region.element == ElementType::beam) {
      properties.resolved_frequency = region.resolved_frequency;
    }
    if (is_flexible_in_shear(region)) {
      properties.shear_area_y = region.section->shear_area_y;
      properties.shear_area_z = region.section->shear_area_z;
    }
  }
  return properties;
}

}  // namespace pounding
