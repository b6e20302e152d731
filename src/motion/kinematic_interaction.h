#pragma once

#include "motion/accelerogram.h"
#include "scene/scene.h"

/// Kinematic interaction: how a rigid foundation without mass moves that lies in soil which
/// vertical shear waves pass through. With a0 = omega D / V_s and a level motion u_g of the surface
/// there are, for D the depth of the underside and L half a side of it,
///
///     u / u_g = cos min(a0, 1.1),      theta / u_g = 0.26 / L (1 - cos min(a0, pi / 2))
///
/// NIST GCR 12-917-21, section 3.2.2, after Kausel, Whitman, Elsabee and Morray (1978). The factors
/// are real, so nothing is late.
namespace pounding {

/// Level acceleration of the underside [m/s2], from that of the surface. It goes on until nothing
/// is left of the filter; its part before t = 0 comes after it, so that the underside comes to rest
/// where the surface does.
Accelerogram embedded_translation(const Accelerogram& surface, const Embedment& embedment);

/// Angular acceleration [rad/s2]; positive: the top goes further than the underside along the
/// motion of the surface.
Accelerogram embedded_rotation(const Accelerogram& surface, const Embedment& embedment);

}  // namespace pounding
