#pragma once

#include "common/petsc.h"

namespace pounding {

/// Factor L D L^T of a symmetric matrix by MUMPS, its rows ordered, none of its numbers computed.
struct FactorPlan {
  MatHandle factor;
  double memory = 0;  ///< that it will take on all ranks together, as MUMPS expects [B]
};

/// Orders the rows; `workspace` [per cent]: beyond MUMPS's own estimate. Collective over the
/// matrix.
FactorPlan plan_factor(Mat matrix, int workspace);

/// Memory that a factor may take [B]: 0.8 of the memory that the system could still give, since its
/// size is an estimate. Local.
double memory_for_factor();

}  // namespace pounding
