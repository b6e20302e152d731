#include "dynamics/rest_forces.h"

namespace pounding {

bool damped_about_rest(const LinearSystem& system) {
  return system.uniform_damping && !system.uniform_damping->filters.empty() &&
         !system.rest_displacement.empty();
}

bool any_damped_about_rest(const LinearSystem& system) {
  int any = damped_about_rest(system) ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, system.comm);
  return any != 0;
}

std::vector<double> rest_forces(const LinearSystem& system) {
  if (!any_damped_about_rest(system)) return {};
  const double* const rest = system.rest_displacement.data();
  std::vector<double> forces(system.rest_displacement.size());
  stiffness::StoredForces store(forces.data());
  system.stiffness->apply({rest, rest, 0}, store);
  return forces;
}

}  // namespace pounding
