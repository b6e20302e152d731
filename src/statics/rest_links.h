#pragma once

#include <memory>
#include <span>
#include <vector>

#include "interactions/laws/link_law.h"
#include "statics/link_terms.h"

namespace pounding {

/// Springs, bars and sections of this rank that yield by a law of their own, at rest: their history
/// goes from nothing to the rest at once. It borrows the system's links. Local.
class RestLinks {
 public:
  explicit RestLinks(const LinearSystem& system);

  /// Adds their forces at displacements of the owned dofs [m, rad], less those of their first
  /// slopes, to `force` [N, N m]; returns whether any is beyond its first corner.
  bool add_forces(const std::vector<double>& displacement, std::span<double> force) const;

 private:
  std::vector<LinkTerms> terms_;
  std::vector<std::unique_ptr<interactions::LinkLaw>> laws_;  ///< per term
};

}  // namespace pounding
