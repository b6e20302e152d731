#include "system/linear_system.h"

namespace pounding {

std::vector<double> LinearSystem::influence(int d) const {
  std::vector<double> iota(direction.size());
  for (std::size_t i = 0; i < iota.size(); ++i) {
    iota[i] = direction[i] == d ? 1 : 0;
  }
  return iota;
}

VecHandle wrap_vector(const LinearSystem& system, std::vector<double>& storage) {
  VecHandle vector;
  POUNDING_PETSC(VecCreateMPIWithArray(system.comm, 1, system.owned_dofs(), PETSC_DECIDE,
                                       storage.data(), vector.out()));
  return vector;
}

}  // namespace pounding
