#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <vector>

#include "stiffness/element_stiffness.h"
#include "support/built_system.h"

namespace pounding::testing_support {

/// A structure with both products.
struct BuiltStiffness {
  Mesh mesh;
  LinearSystem system;
  std::unique_ptr<stiffness::ElementStiffness> stiffness;
};

inline BuiltStiffness with_elements(const Structure& structure, BuiltSystem&& assembled) {
  BuiltStiffness built{std::move(assembled.mesh), std::move(assembled.system), nullptr};
  built.stiffness = std::make_unique<stiffness::ElementStiffness>(
      structure, built.mesh, std::move(built.system.stiffness));
  return built;
}

/// Over all ranks, partitioned as the program does it. Collective.
inline BuiltStiffness build_stiffness(const GlobalMesh& global, const Structure& structure) {
  return with_elements(structure, build_system(global, structure));
}

/// With a partition of one's own. Collective over `comm`.
inline BuiltStiffness build_stiffness(MPI_Comm comm, const GlobalMesh& global,
                                      const Structure& structure, const Partition& partition) {
  return with_elements(structure, build_system(comm, global, structure, partition));
}

/// One value per node of the file and component, whatever the number of ranks.
inline std::vector<double> random_field(const Mesh& mesh, unsigned seed) {
  std::vector<double> field(static_cast<std::size_t>(mesh.owned_dofs));
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
    const auto number = static_cast<unsigned>(mesh.file_node[static_cast<std::size_t>(node)]);
    std::mt19937 generator(seed + 7919 * number);
    std::uniform_real_distribution<double> values(-1, 1);
    for (int c = 0; c < 6; ++c) {
      const double value = values(generator);
      const LocalIndex dof = mesh.dof(node, c);
      if (dof >= 0) field[static_cast<std::size_t>(dof)] = value;
    }
  }
  return field;
}

/// Largest difference to the assembled product, over the largest force, on all ranks.
inline double difference_to_assembled(const BuiltStiffness& built) {
  std::array<double, 2> largest{0, 0};
  for (unsigned seed = 1; seed <= 3; ++seed) {
    std::vector<double> w = random_field(built.mesh, seed);
    std::vector<double> expected(w.size(), 0.0);
    std::vector<double> found(w.size(), NAN);
    const VecHandle argument = wrap_vector(built.system, w);
    const VecHandle assembled = wrap_vector(built.system, expected);
    const VecHandle force = wrap_vector(built.system, found);
    POUNDING_PETSC(MatMult(built.stiffness->matrix(), argument.get(), assembled.get()));
    built.stiffness->apply(argument.get(), force.get());
    for (std::size_t i = 0; i < w.size(); ++i) {
      const double error = std::abs(found[i] - expected[i]);
      largest[0] = std::isfinite(error) ? std::max(largest[0], error) : INFINITY;
      largest[1] = std::max(largest[1], std::abs(expected[i]));
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), 2, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
  return largest[0] / largest[1];
}

inline void move_nodes(GlobalMesh& mesh, const std::function<Vector3(Vector3)>& map) {
  for (GlobalIndex node = 0; node < mesh.node_count(); ++node) {
    const Vector3 x = map(mesh.position(node));
    std::copy(x.begin(), x.end(), &mesh.coordinates[static_cast<std::size_t>(3 * node)]);
  }
}

}  // namespace pounding::testing_support
