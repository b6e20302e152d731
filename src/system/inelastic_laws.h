#pragma once

#include <vector>

#include "laws/element_law.h"
#include "mesh/mesh.h"
#include "scene/scene.h"

namespace pounding {

/// Law in one dimension that a motion with the stiffness `elastic` [N/m] follows in series with
/// `law`, whose elongations are those of its own part. Throws std::domain_error where the sum of
/// both elongations would go back.
Hysteresis in_series(const Hysteresis& law, double elastic);

/// Laws of the regions of a structure whose elements yield by a law of e_n: beams by their
/// sections, shells in shear or by cracks, springs and bars along and about their axes. Throws
/// UserError on every rank where an element cannot follow them. Collective over the mesh's
/// communicator.
std::vector<interactions::RegionLaw> inelastic_laws(const Structure& structure, const Mesh& mesh);

}  // namespace pounding
