#pragma once

#include <map>
#include <vector>

#include "mesh/followed_facets.h"

namespace pounding {

/// Rows of nodes of a tie that follow by their facets, instead of at their places: with F(x) what a
/// place follows (FollowedFacets::follow), phi_k the shares of the nodes on their own facets and
/// mu_i those dual to them,
///
///     B_i = sum of w mu_i F / sum of w mu_i,     sum of w mu_i phi_k = 0 for k other than i
///
/// over the Gauss points of what the facets of both sides have in common. So a constant traction
/// goes to every corner of a flat face as its own share of it, and a linear motion is followed
/// exactly. Where the facet followed turns, what a facet of the nodes bends between its corners is
/// taken off F: constant curvature is followed exactly as well.
///
/// `places`: what each node follows at its place, of all nodes of `facets`. Nodes are left out
/// whose facets lie over what is followed by less than half, in sums of phi_i: they are beside its
/// border, or are points and lines that follow faces. Where a row is that of the place but for
/// round-off it is that of the place. B_i = sum M_ij / D_ii of mortar methods with dual multipliers
/// (Wohlmuth, SIAM J. Numer. Anal. 38, 2000), over the covered part of a facet at a border
/// (Cichosz and Bischoff, Comput. Methods Appl. Mech. Eng. 200, 2011). Serial.
std::map<GlobalIndex, TiedNode> mortar_rows(const GlobalMesh& mesh,
                                            const std::vector<Facet>& facets,
                                            const FollowedFacets& followed,
                                            const std::map<GlobalIndex, TiedNode>& places);

}  // namespace pounding
