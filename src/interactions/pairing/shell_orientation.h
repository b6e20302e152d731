#pragma once

#include <span>
#include <vector>

#include "mesh/global_mesh.h"

namespace pounding::interactions {

/// Which facets of shells have their nodes in an order that is to be reversed, so that facets with
/// a common edge are all seen from the same side; the first one of a connected set keeps its own.
/// Only edges that two of the facets share connect them. A number other than 0 per facet to
/// reverse; facets with 0 in `shells` take no part.
std::vector<char> reversed_shells(std::span<const Facet> facets, std::span<const char> shells);

}  // namespace pounding::interactions
