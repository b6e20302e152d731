#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "common/petsc.h"
#include "common/types.h"

namespace pounding {

/// What a stiffness is applied to, w = u + beta v over the owned dofs; formed where it is read.
struct StiffnessArgument {
  const double* displacement = nullptr;  ///< u [m, rad]
  const double* velocity = nullptr;      ///< v [m/s, rad/s]
  double beta = 0;                       ///< [s]
  /// A translation [m] that elements which do not feel it may take off first: what is left of a
  /// body far from where it started has more digits.
  std::array<double, 3> origin{};

  double operator[](std::size_t dof) const { return displacement[dof] + beta * velocity[dof]; }
  double operator[](LocalIndex dof) const { return (*this)[static_cast<std::size_t>(dof)]; }
};

/// Owned dofs that follow each other.
struct DofRange {
  LocalIndex begin = 0;
  LocalIndex end = 0;
  bool empty() const { return begin >= end; }
};

/// Takes a product K w range by range, while it is in the nearest cache.
class ForceReceiver {
 public:
  virtual ~ForceReceiver() = default;
  /// Forces of the owned dofs [begin, end) are final, force[0] being that of `begin`; nothing reads
  /// u and v of these dofs any more, so the receiver may change them. Ranges hold whole nodes and
  /// come in a fixed order, each owned dof once per product.
  virtual void receive(LocalIndex begin, LocalIndex end, const double* force) = 0;
};

/// Keeps a product in an array over the owned dofs, which must outlive this object.
class StoredForces final : public ForceReceiver {
 public:
  explicit StoredForces(double* product) : product_(product) {}
  void receive(LocalIndex begin, LocalIndex end, const double* force) override {
    std::copy(force, force + (end - begin), product_ + begin);
  }

 private:
  double* product_;
};

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

}  // namespace pounding
