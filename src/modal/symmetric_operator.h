#pragma once

#include "common/petsc.h"

namespace pounding {

/// A symmetric matrix over the owned dofs of a structure that is known by its products alone.
class SymmetricOperator {
 public:
  SymmetricOperator() = default;
  SymmetricOperator(const SymmetricOperator&) = delete;
  SymmetricOperator& operator=(const SymmetricOperator&) = delete;
  virtual ~SymmetricOperator() = default;

  /// A matrix of its size, for the layout of vectors. Borrowed.
  virtual Mat matrix() const = 0;
  /// y = A x. Collective.
  virtual void apply(Vec x, Vec y) const = 0;
};

}  // namespace pounding
