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

}  // namespace pounding
