#pragma once

#include "mesh/mesh.h"
#include "modal/modal_analysis.h"
#include "modal/modal_basis.h"
#include "scene/scene.h"
#include "system/linear_system.h"

/// Limits of the time step of a structure, of whatever kind it is. This is the only place that
/// chooses between the frequencies of a basis, the closed form of plain Rayleigh damping (Eq. 12 of
/// Ambiel et al. 2022) and an eigenvalue iteration for any other damping.
namespace pounding {

struct StructureLimits {
  LargestFrequency largest;     ///< omega_max and where it is
  double stable_time_step = 0;  ///< exact [s]; infinite where nothing vibrates
};

/// `basis` is null for a structure that is not reduced. Collective.
StructureLimits limits_of(const Structure& structure, const LinearSystem& system, const Mesh& mesh,
                          const ModalBasis* basis, const EigenvalueEffort& effort);

/// Smallest eigenvalue of M^-1 (M - dt/2 C - dt^2/4 K) at a time step [-], positive if and only if
/// the step is stable: see `energy_margin` of stable_time_step.h. Collective.
double energy_margin_of(const Structure& structure, const LinearSystem& system, const Mesh& mesh,
                        const ModalBasis* basis, const StructureLimits& limits, double time_step,
                        const EigenvalueEffort& effort);

}  // namespace pounding
