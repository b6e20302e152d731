#pragma once

#include <span>
#include <vector>

#include <metis.h>

#include "mesh/element_graph.h"

namespace pounding {

/// Owner of every node of all structures: the part of most of its elements. Where two parts have as
/// many of them, as along a straight cut, all such nodes of the two go to one part, which then
/// holds the elements on both sides of the cut: the longest cuts first, each to the part that holds
/// less by then. `owner`, `cost`: of the elements. Serial.
std::vector<int> node_owners(const NodeElements& at, std::span<const idx_t> owner,
                             std::span<const idx_t> cost, int parts);

}  // namespace pounding
