#pragma once

#include <vector>

#include "system/linear_system.h"

namespace pounding {

/// A tension-only bar over the owned dofs of its structure, or its generalised coordinates: its
/// elongation is sum of coefficient x dof.
struct BarTerms {
  double stiffness = 0;  ///< k [N/m]
  std::vector<LocalIndex> dofs;
  std::vector<double> coefficients;  ///< b, not zero [-]
};

/// The tension-only bars of this rank; links that hold no force at rest, dashpots, are none. Local.
std::vector<BarTerms> bar_terms(const LinearSystem& system);

}  // namespace pounding
