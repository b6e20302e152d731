#pragma once

#include <vector>

#include "common/doubts.h"
#include "mesh/connectivity.h"
#include "mesh/global_mesh.h"
#include "scene/scene.h"

/// Checks of a structure's mesh for faults, in view of the whole scene. Serial; the thresholds are
/// in docs/reference/input-checks.md.
namespace pounding {

/// Throws UserError where matrices are to be written of a structure that matrices do not hold
/// wholly.
void check_export(const Scene& scene, const Structure& structure, const GlobalMesh& mesh);

/// The groups of places that no option of the scene names. Throws UserError where elements are left
/// out: those of a group that no option names, or of no group, unless `<structure>_ignore` does.
std::vector<UnusedElements> check_unused(const Scene& scene, const Structure& structure,
                                         const GlobalMesh& mesh);

/// Throws UserError where pieces are not joined that lie on each other, or where nothing holds what
/// must be held, unless `<structure>_allow_loose`. Pieces may fly with an initial motion; a
/// structure that nothing holds, with gravity and a contact as well, or where no ground motion
/// acts.
void check_connectivity(const Scene& scene, const Structure& structure,
                        const Connectivity& connectivity);

/// Adds doubts about a mesh: nodes that coincide within one piece, the size of a whole, the point
/// about which its embedded foundation turns, and thick beams that leave shear out.
void add_mesh_doubts(const Scene& scene, const Structure& structure, const GlobalMesh& mesh,
                     const Connectivity& connectivity, Doubts doubts);

}  // namespace pounding
