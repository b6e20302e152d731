#pragma once

#include <memory>
#include <vector>

#include "common/matrix3.h"
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
/// is K u. With an axial strength the laws in bending follow 1 - (|N| / N_y)^a of theirs, N the
/// axial force E A / h times the axial elongation. Throws UserError where an element is too long
/// for a skeleton that falls. Local.
std::shared_ptr<interactions::ElementLaw> yielding_beams(const Structure& structure,
                                                         const Mesh& mesh, int region);

/// A motion of the nodes of a beam whose section yields, and the law that it follows in place of
/// its part of K.
struct SectionMotion {
  std::vector<double> shape;  ///< of 12 numbers: its elongation is shape . u of both nodes [m, rad]
  double stiffness = 0;       ///< of K [N/m, N m]
  Hysteresis law;
};

/// Motions of a beam of a region between two places, in the order of YieldingSection::names.
/// Throws std::domain_error as in_series does.
std::vector<SectionMotion> section_motions(const Region& region, const Vector3& first,
                                           const Vector3& second);

/// Law in one dimension that a motion with the stiffness `elastic` [N/m] follows in series with
/// `law`, whose elongations are those of its own part. Throws std::domain_error where the sum of
/// both elongations would go back.
Hysteresis in_series(const Hysteresis& law, double elastic);

}  // namespace pounding
