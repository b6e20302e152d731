#pragma once

#include <memory>
#include <span>
#include <vector>

#include "interactions/laws/link_law.h"
#include "interactions/solvers/law_solver.h"
#include "system/links.h"

namespace pounding::interactions {

/// Links of a structure that yield, mostly one by one; the two horizontal components of a bearing
/// yield together, by the resultant of their trials, and those of a sliding one at a capacity that
/// follows from the force on it. Local.
class YieldGroups {
 public:
  explicit YieldGroups(std::span<const Link> links);

  /// Yields from e_n, before any force of the step is known.
  void yield(std::span<const std::unique_ptr<LinkLaw>> laws, std::span<const double> now,
             LawMemory& memory) const;

 private:
  struct Group {
    std::vector<std::size_t> links;
    int gauge = -1;       ///< link whose force presses a sliding bearing; -1: none
    double friction = 0;  ///< of such a bearing: capacity over minus the gauge's elongation [N/m]
    double pressing = 0;  ///< force that presses on it, over the same [N/m]
  };
  std::vector<Group> groups_;
};

}  // namespace pounding::interactions
