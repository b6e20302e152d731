#pragma once

#include <functional>
#include <span>
#include <vector>

#include "common/petsc.h"
#include "mesh/mesh.h"
#include "stiffness/rows/product.h"

namespace pounding::stiffness {

/// How K is applied. Vectors are distributed over the structure's communicator, owned dofs only.
class Stiffness {
 public:
  virtual ~Stiffness() = default;
  /// K w [N, N m], handed over range by range, in two parts: `start` sends to other ranks what they
  /// need of w, `finish` does the work with the same w. Allocates nothing. Collective.
  virtual void start(const StiffnessArgument& w) const = 0;
  virtual void finish(const StiffnessArgument& w, ForceReceiver& receiver) const = 0;
  void apply(const StiffnessArgument& w, ForceReceiver& receiver) const {
    start(w);
    finish(w, receiver);
  }
  /// q = K w [N, N m]. Collective.
  virtual void apply(Vec w, Vec q) const = 0;
  /// The matrix itself, for modes and export; null where products do without and nobody asked for
  /// it. Borrowed.
  virtual Mat matrix() const = 0;
  /// Frees the matrix if products do without.
  virtual void release_matrix() {}
};

/// K as an assembled sparse matrix.
class AssembledStiffness final : public Stiffness {
 public:
  explicit AssembledStiffness(MatHandle matrix);
  using Stiffness::apply;
  void start(const StiffnessArgument&) const override {}
  void finish(const StiffnessArgument& w, ForceReceiver& receiver) const override;
  void apply(Vec w, Vec q) const override { POUNDING_PETSC(MatMult(matrix_.get(), w, q)); }
  Mat matrix() const override { return matrix_.get(); }

 private:
  MatHandle matrix_;
  VecHandle argument_;
  VecHandle force_;
};

/// K as a diagonal: omega^2 of generalised coordinates whose basis is orthonormal in M. Nothing is
/// exchanged between ranks.
class DiagonalStiffness final : public Stiffness {
 public:
  /// `diagonal` of the owned dofs. Collective over `comm`.
  DiagonalStiffness(MPI_Comm comm, std::vector<double> diagonal);
  using Stiffness::apply;
  void start(const StiffnessArgument&) const override {}
  void finish(const StiffnessArgument& w, ForceReceiver& receiver) const override;
  void apply(Vec w, Vec q) const override;
  Mat matrix() const override { return matrix_.get(); }

 private:
  std::vector<double> diagonal_;
  mutable std::vector<double> force_;
  MatHandle matrix_;
};

// Empty PETSc matrices, from which an assembly starts.

/// An empty symmetric AIJ matrix with room for what the elements of some blocks of a structure
/// couple (all if `chosen` is empty); rows and columns over its owned dofs. Collective.
MatHandle create_matrix(const Mesh& mesh,
                        const std::function<bool(const ElementBlock&)>& chosen = {});

/// Adds an element matrix, shape (n, n), of local dofs (-1: none) to a matrix over all dofs, in the
/// rows that this rank owns; `numbers`: see global_numbers.
void add_element(const Mesh& mesh, std::span<const PetscInt> numbers,
                 std::span<const LocalIndex> dofs, const double* values, Mat matrix);

/// Global numbers of all local dofs, owned then ghost.
std::vector<PetscInt> global_numbers(const Mesh& mesh);

}  // namespace pounding::stiffness
