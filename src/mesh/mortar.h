#pragma once

#include <map>
#include <vector>

#include "mesh/followed_facets.h"

namespace pounding {

/// Rows of nodes of a tie that follow by their facets, instead of at their places: with F(x) the
/// motion that a place follows (FollowedFacets::follow), phi_k the shares of the nodes on their own
/// facets and mu_i those dual to them,
///
///     B_i = sum of w mu_i F / sum of w mu_i,     sum of w mu_i phi_k = 0 for k other than i
///
/// over the Gauss points of the overlap of the facets of both sides. So a constant traction goes to
/// every corner of a flat face as its own share of it, and a linear motion is followed exactly.
/// Where the facet followed turns, the bending of the nodes' facet between its corners is taken off
/// F: constant curvature is followed exactly as well.
///
/// `places`: the carriers of each node at its place, of all nodes of `facets`. Nodes are left out
/// whose facets lie over the facets followed by less than half, in sums of phi_i: they are beside
/// its border, or are points and lines that follow faces. Where a row is that of the place but for
/// round-off it is that of the place. B_i = sum M_ij / D_ii of mortar methods with dual multipliers
/// (Wohlmuth, SIAM J. Numer. Anal. 38, 2000), over the covered part of a facet at a border (Cichosz
/// and Bischoff, Comput. Methods Appl. Mech. Eng. 200, 2011). Serial.
std::map<GlobalIndex, TiedNode> mortar_rows(const GlobalMesh& mesh,
                                            const std::vector<Facet>& facets,
                                            const FollowedFacets& followed,
                                            const std::map<GlobalIndex, TiedNode>& places);

}  // namespace pounding
