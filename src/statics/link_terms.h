#pragma once

#include <memory>
#include <vector>

#include "interactions/laws/link_law.h"
#include "system/linear_system.h"
#include "system/links.h"

namespace pounding {

/// A link that holds a force at rest, over the owned dofs of its structure, or its generalised
/// coordinates: its elongation is sum of coefficient x dof.
struct LinkTerms {
  const Link* link = nullptr;
  double stiffness = 0;  ///< k, the largest tangent of its law [N/m]
  bool one_way = false;
  std::vector<LocalIndex> dofs{};
  std::vector<double> coefficients{};  ///< b, not zero [-]

  /// b . u of the owned dofs [m].
  double elongation(const std::vector<double>& u) const {
    double sum = 0;
    for (std::size_t k = 0; k < dofs.size(); ++k) sum += coefficients[k] * u[dofs[k]];
    return sum;
  }
};

/// Tension-only bars, compression-only springs and yielding elements of this rank: links that hold
/// a force at rest, which dashpots do not. They borrow the system's links. Local.
std::vector<LinkTerms> link_terms(const LinearSystem& system);

/// Law of a link, whether or not K holds its tangent already.
std::unique_ptr<interactions::LinkLaw> law_at_rest(const Link& link);

/// Whether a link yields by friction or on a circle, with others.
bool slides(const interactions::LinkOrigin& origin);

}  // namespace pounding
