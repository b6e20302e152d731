#pragma once

#include <memory>

#include "interactions/laws/element_law.h"
#include "mesh/mesh.h"
#include "scene/scene.h"

namespace pounding {

/// Law of the shells of a region that crack. Their mean membrane strains and curvatures e, those at
/// the centre, follow a CrackingShell with forces N(e) per length in place of those of K,
///
///     g = A B^T (N(B u) - D0 B u),        W_n = A (1/2 N . e - S)
///
/// A the area and S the energy that the law holds per area. K less A B^T D0 B is positive or zero,
/// since the energy of mean strains is at most that of all, and the modes of shell4 have no mean.
/// Axes are those of the shell's forces (shell_force_axes). Throws UserError for an element that
/// cannot be. Local.
std::shared_ptr<interactions::ElementLaw> cracking_shells(const Structure& structure,
                                                          const Mesh& mesh, int region);

}  // namespace pounding
