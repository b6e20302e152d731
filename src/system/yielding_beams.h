#pragma once

#include <vector>

#include "interactions/laws/element_law.h"
#include "mesh/mesh.h"
#include "scene/scene.h"

namespace pounding {

/// Laws of the regions of a structure that are marked inelastic: beams whose sections yield. In
/// each of its planes a beam of length h has two motions that its stiffness does not couple, the
/// relative rotation r of its ends, at one curvature, and the sway w of one end beside the other
/// less their mean rotation,
///
///     r = r_2 - r_1,                          M = E I / h r
///     w = w_2 - w_1 - h (r_1 + r_2) / 2,      Q = w / (h / (G A) + h^3 / (12 E I))
///
/// M over r / h follows the law of the section in bending, and Q over the part of w / h that is
/// shear its law in shear, in series with the bending of that motion, which stays elastic. All else
/// is K u. Throws UserError on every rank where an element is too long for a skeleton that falls.
/// Collective over the mesh's communicator.
std::vector<interactions::RegionLaw> yielding_beams(const Structure& structure, const Mesh& mesh);

/// Throws UserError on every rank, naming the element, where one of them is beyond a first corner
/// under the displacements of the owned dofs at rest [m, rad]. Collective likewise.
void require_elastic_rest(const std::vector<interactions::RegionLaw>& laws, const Mesh& mesh,
                          const std::vector<double>& displacement);

/// Law in one dimension that a motion with the stiffness `elastic` [N/m] follows in series with
/// `law`, whose elongations are those of its own part. Throws std::domain_error where the sum of
/// both elongations would go back.
Hysteresis in_series(const Hysteresis& law, double elastic);

}  // namespace pounding
