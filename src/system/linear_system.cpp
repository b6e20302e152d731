#include "system/linear_system.h"

#include "common/petsc.h"

namespace pounding {

std::vector<double> LinearSystem::influence(int d) const {
  if (generalised) return generalised->influence[d];
  std::vector<double> iota(direction.size());
  for (std::size_t i = 0; i < iota.size(); ++i) iota[i] = direction[i] == d ? 1 : 0;
  return iota;
}

std::vector<double> LinearSystem::ground_load(int d) const {
  std::vector<double> load = influence(d);
  for (std::size_t i = 0; i < load.size(); ++i) load[i] *= lumped_mass[i];
  for (std::size_t k = 0; k < water.dofs.size(); ++k) load[water.dofs[k]] += water.force[d][k];
  return load;
}

GlobalIndex LinearSystem::independent_dofs() const {
  GlobalIndex count = global_dofs;
  for (const RigidBodyReport& body : rigid_bodies) count -= body.dofs - body.motions;
  return count;
}

LinearSystem describe_system(const Structure& structure, const Mesh& mesh) {
  LinearSystem system;
  system.name = structure.name;
  system.comm = mesh.comm;
  system.damping = structure.damping;
  system.uniform_damping = structure.uniform_damping;
  system.initial_displacement = structure.initial_displacement;
  system.initial_velocity = structure.initial_velocity;
  system.gravity = structure.gravity;
  system.global_dofs = mesh.global_dofs;
  system.wet = !mesh.water.empty();
  system.has_laws_beside = std::ranges::any_of(structure.regions, follows_law);
  return system;
}

void finish_system(const Mesh& mesh, LinearSystem& system) {
  system.inverse_mass.resize(system.lumped_mass.size());
  for (std::size_t i = 0; i < system.lumped_mass.size(); ++i) {
    system.inverse_mass[i] = 1 / system.lumped_mass[i];
  }
  system.direction.assign(system.lumped_mass.size(), -1);
  for_each_owned_dof(mesh, [&](LocalIndex dof, LocalIndex, int c) {
    if (c < 3) system.direction[dof] = static_cast<std::int8_t>(c);
  });
}

VecHandle create_vector(const LinearSystem& system) {
  VecHandle vector;
  POUNDING_PETSC(VecCreate(system.comm, vector.out()));
  POUNDING_PETSC(VecSetSizes(vector.get(), system.owned_dofs(), PETSC_DECIDE));
  POUNDING_PETSC(VecSetType(vector.get(), VECSTANDARD));
  return vector;
}

VecHandle wrap_vector(const LinearSystem& system, std::vector<double>& storage) {
  VecHandle vector;
  POUNDING_PETSC(VecCreateMPIWithArray(system.comm, 1, system.owned_dofs(), PETSC_DECIDE,
                                       storage.data(), vector.out()));
  return vector;
}

}  // namespace pounding
