#pragma once

#include <memory>
#include <span>

#include "mesh/mesh.h"
#include "scene/scene.h"
#include "system/linear_system.h"
#include "system/support_shapes.h"

namespace pounding {

/// How a structure at full order follows the columns of its supports: for each that carries it,
///
///     K iota = -K_s w
///
/// by corrections (K + sigma M) d = -(K_s w + K iota), iota <- iota + d, with sigma = 1 / s2, from
/// zero on. K of the linear elements may be singular: parts that they do not hold keep their place,
/// since no support pulls on these. The products are those of the step, so that K iota + K_s w
/// is zero for them to round-off. Where all the ground moves with one support, w is that of
/// the ends of springs in the ground as well, and iota begins as the rigid motion of all nodes: of
/// a displacement it is that. Needs the matrix of the system. Null if the structure is on
/// no support that moves on its own. Throws UserError naming the structure where the corrections do
/// not end. Collective.
std::shared_ptr<SupportShapes> find_support_shapes(const Structure& structure, const Mesh& mesh,
                                                   const LinearSystem& system,
                                                   std::span<const SupportColumn> columns,
                                                   SolverChoice solver);

}  // namespace pounding
