#pragma once

#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding {

/// Adds the ties of a structure to the rigid parts of its mesh, one for all nodes that ties join
/// with each other, and their doubts. The nodes of a tie's first group follow facets of the second,
/// as means over their own facets where these lie over those (see mortar_rows), elsewhere the facet
/// that is nearest to them. A place follows, of a facet with rotations at all corners,
///
///     u = sum N_i (u_i + theta_i x d) + sum b_ij (theta_i - theta_j) x (x_j - x_i) / 8
///     theta = sum N_i theta_i
///
/// d from the nearest place of the facet to it, N_i the corners' shares there, b_ij the bulge of
/// the edge from i to j, so that beams and plates of constant curvature are followed exactly; of
/// edges of shells only the part out of their plane. Faces of solids turn by theta:
///
///     u = sum N_i u_i + theta x d
///     theta = sum (grad N_i x n) (n . u_i) + n (n x grad N_i) . u_i / 2
///
/// Own; the bulges are the linked interpolation of Zienkiewicz et al. (Int. J. Num. Meth. Eng. 36,
/// 1993). Throws UserError naming the place of a node with no facet near, of one that is clamped or
/// in a rigid group, follows twice or follows one that follows. Groups must have nodes in use.
/// Serial.
void add_tied_nodes(const Structure& structure, GlobalMesh& mesh);

}  // namespace pounding
