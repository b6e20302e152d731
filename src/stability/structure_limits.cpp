#include "stability/structure_limits.h"

#include "modal/reduced_system.h"
#include "stability/stability_limit.h"
#include "stability/stable_time_step.h"

namespace pounding {

StructureLimits limits_of(const Structure& structure, const LinearSystem& system, const Mesh& mesh,
                          const ModalBasis* basis, const EigenvalueEffort& effort) {
  if (basis != nullptr) {
    return {largest_frequency(structure, *basis), stable_time_step(structure, *basis)};
  }
  StructureLimits limits{largest_frequency(system, mesh, effort), 0};
  limits.stable_time_step =
      system.has_extra_damping()
          ? stability_limit(system, mesh, effort)
          : stable_time_step(system.damping, limits.largest.omega_max, system.stiffening());
  return limits;
}

double energy_margin_of(const Structure& structure, const LinearSystem& system, const Mesh& mesh,
                        const ModalBasis* basis, const StructureLimits& limits, double time_step,
                        const EigenvalueEffort& effort) {
  if (basis != nullptr) return energy_margin(structure, *basis, time_step);
  return system.has_extra_damping() ? smallest_energy_margin(system, mesh, time_step, effort)
                                    : energy_margin(system.damping, limits.largest.omega_max,
                                                    time_step, system.stiffening());
}

}  // namespace pounding
