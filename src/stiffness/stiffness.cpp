#include "stiffness/stiffness.h"

#include <algorithm>
#include <array>

#include "elements/element_traits.h"

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

AssembledStiffness::AssembledStiffness(MatHandle matrix) : matrix_(std::move(matrix)) {
  POUNDING_PETSC(MatCreateVecs(matrix_.get(), argument_.out(), force_.out()));
}

void AssembledStiffness::finish(const StiffnessArgument& w, ForceReceiver& receiver) const {
  PetscInt size = 0;
  POUNDING_PETSC(VecGetLocalSize(argument_.get(), &size));
  double* argument = nullptr;
  POUNDING_PETSC(VecGetArrayWrite(argument_.get(), &argument));
  for (PetscInt i = 0; i < size; ++i) argument[i] = w[i];
  POUNDING_PETSC(VecRestoreArrayWrite(argument_.get(), &argument));
  POUNDING_PETSC(MatMult(matrix_.get(), argument_.get(), force_.get()));
  const VecReader force(force_.get());
  receiver.receive(0, static_cast<LocalIndex>(size), force.data());
}

DiagonalStiffness::DiagonalStiffness(MPI_Comm comm, std::vector<double> diagonal)
    : diagonal_(std::move(diagonal)),
      force_(diagonal_.size(), 0.0),
      matrix_(diagonal_matrix(comm, diagonal_)) {}

void DiagonalStiffness::finish(const StiffnessArgument& w, ForceReceiver& receiver) const {
  for (std::size_t i = 0; i < force_.size(); ++i) {
    force_[i] = diagonal_[i] * w[i];
  }
  receiver.receive(0, static_cast<LocalIndex>(force_.size()), force_.data());
}

void DiagonalStiffness::apply(Vec w, Vec q) const {
  const VecReader argument(w);
  double* force = nullptr;
  POUNDING_PETSC(VecGetArrayWrite(q, &force));
  for (std::size_t i = 0; i < diagonal_.size(); ++i) {
    force[i] = diagonal_[i] * argument[static_cast<int>(i)];
  }
  POUNDING_PETSC(VecRestoreArrayWrite(q, &force));
}

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

void add_element(const Mesh& mesh, std::span<const PetscInt> numbers,
                 std::span<const LocalIndex> dofs, const double* values, Mat matrix) {
  std::array<PetscInt, max_element_size> rows{};
  std::array<PetscInt, max_element_size> columns{};
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    columns[i] = dofs[i] >= 0 ? numbers[dofs[i]] : -1;
    rows[i] = dofs[i] < mesh.owned_dofs ? columns[i] : -1;
  }
  const auto n = static_cast<PetscInt>(dofs.size());
  POUNDING_PETSC(MatSetValues(matrix, n, rows.data(), n, columns.data(), values, ADD_VALUES));
}

std::vector<PetscInt> global_numbers(const Mesh& mesh) {
  std::vector<PetscInt> numbers(mesh.dof_count);
  for_each_dof(mesh, 0, mesh.node_count(), [&](LocalIndex dof, LocalIndex node, int c) {
    numbers[dof] = static_cast<PetscInt>(mesh.dof_global(node, c));
  });
  return numbers;
}

}  // namespace pounding::stiffness
