#pragma once

#include <vector>

#include "system/linear_system.h"

namespace pounding {

/// A one-way link over the owned dofs of its structure, or its generalised coordinates: its
/// elongation is sum of coefficient x dof.
struct LinkTerms {
  double stiffness = 0;  ///< k [N/m]
  std::vector<LocalIndex> dofs;
  std::vector<double> coefficients;  ///< b, not zero [-]
};

/// Tension-only bars and compression-only springs of this rank: links that hold a force at rest,
/// which dashpots do not. Local.
std::vector<LinkTerms> link_terms(const LinearSystem& system);

}  // namespace pounding
