#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include <mpi.h>

#include "common/types.h"
#include "scene/scene.h"
#include "system/stiffness.h"

namespace pounding {

/// One building as a linear second-order system in the ground frame, whatever its origin:
///
///     M u'' + C u' + K u = -M iota a_g(t) + L^T r,      C = alpha M + beta K,  M diagonal
///
/// Arrays hold this rank's owned dofs. Constant during a run.
struct LinearSystem {
  std::string name;
  MPI_Comm comm = MPI_COMM_SELF;
  Rayleigh damping;
  GlobalIndex global_dofs = 0;
  std::vector<double> lumped_mass;               ///< M [kg, kg m2]
  std::vector<double> inverse_mass;              ///< [1/kg, 1/(kg m2)]
  std::array<std::vector<double>, 3> influence;  ///< iota per direction: 1 on its translations [-]
  std::unique_ptr<Stiffness> stiffness;
  double total_mass = 0;  ///< clamped nodes included [kg]
  /// Upper bound of omega_max from single elements, and who holds it: the element with the largest
  /// omega of its own.
  double element_frequency_bound = 0;  ///< [rad/s]
  std::string stiffest_element;

  LocalIndex owned_dofs() const { return static_cast<LocalIndex>(lumped_mass.size()); }
};

/// Distributed vector over the owned dofs that uses `storage` as its memory (size: owned_dofs).
VecHandle wrap_vector(const LinearSystem& system, std::vector<double>& storage);

}  // namespace pounding
