#pragma once

#include "common/petsc.h"
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

}  // namespace pounding::stiffness
