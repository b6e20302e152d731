#pragma once

#include <string>
#include <vector>

#include "system/linear_system.h"

namespace pounding {

/// A link that holds a force at rest, over the owned dofs of its structure, or its generalised
/// coordinates: its elongation is sum of coefficient x dof.
struct LinkTerms {
  double stiffness = 0;  ///< k [N/m]
  bool one_way = false;
  double slack = 0;         ///< elongation at which it begins to hold [m]
  double yield_force = 0;   ///< beyond which it is no rest [N]; 0: it does not yield
  bool pulls_only = false;  ///< beyond which it holds nothing: no rest where it is pressed
  std::string place;        ///< of one that yields, for messages
  std::vector<LocalIndex> dofs;
  std::vector<double> coefficients;  ///< b, not zero [-]

  /// b . u of the owned dofs [m].
  double elongation(const std::vector<double>& u) const {
    double sum = 0;
    for (std::size_t k = 0; k < dofs.size(); ++k) sum += coefficients[k] * u[dofs[k]];
    return sum;
  }
};

/// Tension-only bars, compression-only springs and what yields of this rank: links that hold a
/// force at rest, which dashpots do not. Local.
std::vector<LinkTerms> link_terms(const LinearSystem& system);

}  // namespace pounding
