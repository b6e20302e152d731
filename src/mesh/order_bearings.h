#pragma once

#include "mesh/global_mesh.h"

namespace pounding {

/// Orders the two nodes of every sliding bearing and pendulum: the second one is the one that it
/// carries. Across the plane in which it slides that is the node on the side against gravity
/// (without gravity there, of the greater coordinate); where both lie at one level, by
/// `coincidence` of the mesh's diagonal, the one that more springs, one after the other, part from
/// clamped nodes, grounded ones or an absorbing face. Notes a doubt of those that are upside down,
/// by both of these. Throws UserError where neither decides. Absorbing nodes must be known. Serial.
void order_sliding_bearings(const Structure& structure, GlobalMesh& mesh);

}  // namespace pounding
