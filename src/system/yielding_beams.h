#pragma once

#include <memory>

#include "interactions/laws/element_law.h"
#include "mesh/mesh.h"
#include "scene/scene.h"

namespace pounding {

/// Law of the beams of a region whose sections yield. In each of its planes a beam of length h has
/// two motions that its stiffness does not couple, the relative rotation r of its ends, at one
/// curvature, and the sway w of one end beside the other less their mean rotation,
///
///     r = r_2 - r_1,                          M = E I / h r
///     w = w_2 - w_1 - h (r_1 + r_2) / 2,      Q = w / (h / (G A) + h^3 / (12 E I))
///
/// M over r / h follows the law of the section in bending, and Q over the part of w / h that is
/// shear its law in shear, in series with the bending of that motion, which stays elastic. All else
/// is K u. Throws UserError where an element is too long for a skeleton that falls. Local.
std::shared_ptr<interactions::ElementLaw> yielding_beams(const Structure& structure,
                                                         const Mesh& mesh, int region);

/// Law in one dimension that a motion with the stiffness `elastic` [N/m] follows in series with
/// `law`, whose elongations are those of its own part. Throws std::domain_error where the sum of
/// both elongations would go back.
Hysteresis in_series(const Hysteresis& law, double elastic);

}  // namespace pounding
