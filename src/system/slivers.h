#pragma once

#include <optional>
#include <span>
#include <string>

#include "mesh/mesh.h"

namespace pounding {

/// Element that by itself allows less than a tenth of the time step of most of its group: the group
/// has one material, section and thickness, so the element is out of shape or too small.
struct Sliver {
  std::string element;    ///< the one of its group that allows least; the first of equals
  GlobalIndex count = 0;  ///< of its group
  double time_step = 0;   ///< that it allows by itself [s]
  double median = 0;      ///< of its group [s]
};

/// The worst sliver of a group, if it has any. `time_steps`, of shape (elements of the block here),
/// holds the step that each of them allows by itself [s]; infinite for an element that limits
/// nothing. The same on all ranks. Collective.
std::optional<Sliver> find_sliver(const Mesh& mesh, const ElementBlock& block,
                                  std::span<const double> time_steps);

}  // namespace pounding
