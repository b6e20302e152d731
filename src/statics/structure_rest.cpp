#include "statics/structure_rest.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/parallel.h"
#include "mesh/location.h"
#include "system/admissible_motions.h"
#include "system/load_shapes.h"

namespace pounding {
namespace {

double largest_size(const Vector3& v) {
  return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
}

/// iota_d^T of a force on the dofs of a structure, all ranks together.
Vector3 total(MPI_Comm comm, const LinearSystem& system, const std::vector<double>& force) {
  Vector3 sum{0, 0, 0};
  for (std::size_t d = 0; d < 3; ++d) {
    const std::vector<double> iota = system.influence(static_cast<int>(d));
    sum[d] = std::inner_product(force.begin(), force.end(), iota.begin(), 0.0);
  }
  reduce_over_ranks(comm, MPI_SUM, sum);
  return sum;
}

/// Forces of the supports, summed up from those of the elements and bars.
void find_support(MPI_Comm comm, const LinearSystem& system, const StaticStiffness& stiffness,
                  const RestFields& at, StructureRest& rest) {
  std::vector<double> force;
  stiffness.apply(at.displacement, force);
  for (std::size_t i = 0; i < force.size(); ++i) {
    force[i] = at.links[i] - force[i] - at.law_force[i];
  }
  const Vector3 free_support = total(comm, system, force);
  const Vector3 free_weight = total(comm, system, at.weight);
  const Vector3 free_contact = total(comm, system, at.contact);
  for (std::size_t i = 0; i < force.size(); ++i) force[i] += at.weight[i] + at.contact[i];
  Vector3 handed = handed_to_clamps(system, force);
  reduce_over_ranks(comm, MPI_SUM, handed);
  Vector3 left{0, 0, 0};
  for (std::size_t d = 0; d < 3; ++d) {
    // Held nodes hand their own part on to the supports.
    const double given = rest.weight[d] + rest.load[d];
    rest.support[d] = free_support[d] - (given - free_weight[d]) -
                      (rest.contact[d] - free_contact[d]) - handed[d];
    left[d] = given + rest.contact[d] + rest.support[d];
  }
  const double scale = std::max({rest.forces, largest_size(rest.weight), largest_size(rest.load),
                                 largest_size(rest.contact), largest_size(rest.support)});
  rest.imbalance = scale > 0 ? largest_size(left) / scale : 0;
}

void find_largest(MPI_Comm comm, const LinearSystem& system, const Mesh& mesh,
                  std::vector<double> values, StructureRest& rest) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (system.direction[i] < 0) values[i] = 0;
    rest.largest_displacement = std::max(rest.largest_displacement, std::abs(values[i]));
  }
  reduce_over_ranks(comm, MPI_MAX, rest.largest_displacement);
  rest.place = locate_largest(mesh, values);
}

}  // namespace

StructureRest describe_rest(MPI_Comm comm, const LinearSystem& system, const Mesh& mesh,
                            const StaticStiffness& stiffness, const RestFields& at) {
  StructureRest rest;
  rest.method = stiffness.method();
  rest.contact = at.pushed;
  std::vector<double> momentum(at.displacement);
  for (std::size_t i = 0; i < momentum.size(); ++i) momentum[i] *= system.lumped_mass[i];
  rest.settlement = total(comm, system, momentum);
  if (system.loads) rest.load = system.loads->total_at_rest();
  for (const double force : at.weight) rest.forces += std::abs(force);
  reduce_over_ranks(comm, MPI_SUM, rest.forces);
  for (std::size_t d = 0; d < 3; ++d) {
    rest.weight[d] = system.total_mass * system.gravity[d];
    rest.settlement[d] /= system.total_mass;
    rest.support[d] = -rest.weight[d] - rest.load[d] - rest.contact[d];
  }
  if (!system.generalised) {
    find_support(comm, system, stiffness, at, rest);
    find_largest(comm, system, mesh, at.displacement, rest);
  }
  return rest;
}

}  // namespace pounding
