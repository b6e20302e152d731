#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "common/types.h"

namespace pounding::stiffness {

/// Argument of a stiffness, w = u + beta v over the owned dofs; formed where it is read.
struct StiffnessArgument {
  const double* displacement = nullptr;  ///< u [m, rad]
  const double* velocity = nullptr;      ///< v [m/s, rad/s]
  double beta = 0;                       ///< [s]
  /// A translation [m] that elements which do not feel it may take off first: what is left of a
  /// body far from where it started has more digits.
  std::array<double, 3> origin{};

  double operator[](std::size_t dof) const { return displacement[dof] + beta * velocity[dof]; }
  double operator[](LocalIndex dof) const { return displacement[dof] + beta * velocity[dof]; }
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

}  // namespace pounding::stiffness
