#pragma once

#include "soil/impedance.h"

namespace pounding {

/// Impedances of a rigid disk of some radius [m] on the surface. With G = rho V_s^2 the springs are
/// 8 G R / (2 - nu) along x and y, 4 G R / (1 - nu) along z, 8 G R^3 / (3 (1 - nu)) about x and y,
/// 16 G R^3 / 3 about z. Over the frequency, with a0 = omega R / V_s:
///
/// - nu = 1/3 (0.328 to 0.338), but for torsion: A. S. Veletsos and B. Verbic, Earthquake
///   Engineering and Structural Dynamics 2 (1973) 87-102;
/// - else, and in torsion: the cones of J. P. Wolf, *Foundation Vibration Analysis Using Simple
///   Physical Models* (1994), a dashpot rho c A for translations, an internal mass rho I z0 with
///   the dashpot rho c I for rotations, and for nu > 1/3 trapped masses along z, about x and y.
Impedances disk_impedances(const HalfSpace& soil, double radius);

}  // namespace pounding
