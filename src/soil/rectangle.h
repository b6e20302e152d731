#pragma once

#include "soil/impedance.h"

namespace pounding {

/// a0 up to which the imaginary part along z stays below the published one [-].
inline constexpr double rectangle_safe_a0 = 2;

/// Impedances of a rigid rectangular mat with full sides along x and y [m], its underside
/// `embedment` below the surface [m]. Static stiffness, its factors of embedment and its real part
/// over the frequency: A. Pais and E. Kausel, Soil Dynamics and Earthquake Engineering 7 (1988)
/// 213-227, as NIST GCR 12-917-21 (2012), tables 2-2 and 2-3, prints them. With half sides L >= B,
/// A = 4 L B and x = a0^2, a0 = omega B / V_s:
///
/// - along the sides: dashpots rho V_s A;
/// - along z: real part K (1 - s x / (d + x)) by an internal mass, and the dashpot that makes the
///   imaginary part omega rho V A at a0 = 2, and less than that below;
/// - about the axes: the real part by an internal mass, whose dashpot makes the imaginary part.
///
/// The sides of an embedded mat radiate nothing here, and do not couple sliding with rocking.
Impedances rectangle_impedances(const HalfSpace& soil, const std::array<double, 2>& sides,
                                double embedment);

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
