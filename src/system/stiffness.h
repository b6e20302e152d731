#pragma once

#include "common/petsc.h"

namespace pounding {

/// How K is applied. Vectors are distributed over the structure's communicator, owned dofs only.
class Stiffness {
 public:
  virtual ~Stiffness() = default;
  /// q = K w [N, N m]. Collective.
  virtual void apply(Vec w, Vec q) const = 0;
  /// The matrix itself, for eigenvalues and export. Borrowed.
  virtual Mat matrix() const = 0;
};

/// K as an assembled sparse matrix.
class AssembledStiffness final : public Stiffness {
 public:
  explicit AssembledStiffness(MatHandle matrix) : matrix_(std::move(matrix)) {}
  void apply(Vec w, Vec q) const override { POUNDING_PETSC(MatMult(matrix_.get(), w, q)); }
  Mat matrix() const override { return matrix_.get(); }

 private:
  MatHandle matrix_;
};

}  // namespace pounding
