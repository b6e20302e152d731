#pragma once

#include "scene/scene.h"
#include "system/linear_system.h"

namespace pounding {

/// Refuses matrices from files under which some motion has negative strain energy, or takes energy
/// out of its damping: M^-1 K and M^-1 D must have no eigenvalue below -1e-11 of the largest. That
/// is counted by a factorisation L D L^T (MUMPS) of either. Does nothing for structures of
/// elements. Throws UserError on every rank alike. Collective.
void require_passive_matrices(const Structure& structure, const LinearSystem& system);

}  // namespace pounding
