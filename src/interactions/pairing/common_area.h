#pragma once

#include <vector>

#include "interactions/pairing/contact_sides.h"
#include "interactions/pairing/facet_finder.h"

namespace pounding::interactions {

/// Area that the facets of a side have in common with those of the other one that look against
/// them, seen along their normals: shares of the side's nodes in it, integrals of their shape
/// functions, in the order of its nodes [m2]. What lies over several facets counts once; facets
/// that lie deeper behind than the elements there have nothing in common. `finder` of the other
/// side; neither side holds lines.
std::vector<double> common_area(const FaceSide& side, const FaceSide& other,
                                const FacetFinder& finder);

}  // namespace pounding::interactions
