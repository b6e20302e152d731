#include "stiffness/sparse_matrix.h"

#include <algorithm>

#include "elements/element.h"

namespace pounding::stiffness {
namespace {

/// Number of entries per owned row in the own and the other columns.
void count_entries(const Mesh& mesh, const std::function<bool(const ElementBlock&)>& chosen,
                   std::vector<PetscInt>& own, std::vector<PetscInt>& other) {
  std::vector<std::vector<LocalIndex>> neighbours(mesh.owned_nodes);
  for (const ElementBlock& block : mesh.blocks) {
    if (chosen && !chosen(block)) continue;
    const std::size_t nodes = element_layout(block.type).nodes;
    for (std::size_t e = 0; e < block.count(); ++e) {
      const LocalIndex* corner = &block.connectivity[e * nodes];
      for (std::size_t a = 0; a < nodes; ++a) {
        if (corner[a] < mesh.owned_nodes) {
          auto& list = neighbours[corner[a]];
          list.insert(list.end(), corner, corner + nodes);
        }
      }
    }
  }
  own.assign(mesh.owned_dofs, 0);
  other.assign(mesh.owned_dofs, 0);
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
    auto& list = neighbours[node];
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    PetscInt own_entries = 0;
    PetscInt other_entries = 0;
    for (const LocalIndex neighbour : list) {
      const int dofs = component_count(mesh.free_components[neighbour]);
      (neighbour < mesh.owned_nodes ? own_entries : other_entries) += dofs;
    }
    const LocalIndex first = mesh.first_dof[node];
    const int rows = component_count(mesh.free_components[node]);
    std::fill_n(own.begin() + first, rows, own_entries);
    std::fill_n(other.begin() + first, rows, other_entries);
  }
}

}  // namespace

MatHandle create_matrix(const Mesh& mesh, const std::function<bool(const ElementBlock&)>& chosen) {
  std::vector<PetscInt> own;
  std::vector<PetscInt> other;
  count_entries(mesh, chosen, own, other);
  MatHandle matrix;
  const LocalIndex n = mesh.owned_dofs;
  POUNDING_PETSC(MatCreateAIJ(mesh.comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, 0, own.data(), 0,
                              other.data(), matrix.out()));
  POUNDING_PETSC(MatSetOption(matrix.get(), MAT_USE_INODES, PETSC_FALSE));
  POUNDING_PETSC(MatSetOption(matrix.get(), MAT_SYMMETRIC, PETSC_TRUE));
  return matrix;
}

std::vector<PetscInt> global_numbers(const Mesh& mesh) {
  std::vector<PetscInt> numbers(mesh.dof_count);
  for (LocalIndex node = 0; node < mesh.node_count(); ++node) {
    for (int c = 0; c < 6; ++c) {
      const LocalIndex dof = mesh.dof(node, c);
      if (dof >= 0) numbers[dof] = static_cast<PetscInt>(mesh.dof_global(node, c));
    }
  }
  return numbers;
}

}  // namespace pounding::stiffness
