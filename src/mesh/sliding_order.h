#pragma once

#include "mesh/global_mesh.h"

namespace pounding {

/// Orders the two nodes of every sliding bearing and pendulum: the second one is what it carries.
/// Across the plane in which it slides that is the node on the side against gravity (without
/// gravity there, of the greater coordinate); where both lie at one level, by `coincidence` of the
/// mesh's diagonal, the one that more springs, one after the other, part from what is clamped,
/// grounded or an absorbing face. Notes a doubt of those that stand on their heads, by both of
/// these. Throws UserError where neither tells. Absorbing nodes must be known. Serial.
void order_sliding_bearings(const Structure& structure, GlobalMesh& mesh);

}  // namespace pounding
