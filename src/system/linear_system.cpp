#include "system/linear_system.h"

namespace pounding {

VecHandle wrap_vector(const LinearSystem& system, std::vector<double>& storage) {
  VecHandle vector;
  POUNDING_PETSC(VecCreateMPIWithArray(system.comm, 1, system.owned_dofs(), PETSC_DECIDE,
                                       storage.data(), vector.out()));
  return vector;
}

}  // namespace pounding
