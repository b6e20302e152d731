#pragma once

#include <array>
#include <complex>

/// Soil under a rigid mat as springs, dashpots and masses whose numbers do not depend on the
/// frequency. Pure functions: no MPI, no PETSc.
namespace pounding {

/// Impedance of the soil in one motion of a mat, along or about an axis. The mat's motion e,
/// relative to the ground far away, meets the force
///
///     N = K e + c e' + F + m3 e'',        F = c1 (e' - F'/k1 - y'),    m y'' = F
///
/// with an internal mass m that a dashpot c1 and, where there is one, a spring k1 in series with it
/// join to the mat and nothing else holds; without a mass they end in the ground.
struct Impedance {
  double stiffness = 0;        ///< K [N/m, N m]
  double dashpot = 0;          ///< c, to the ground [N s/m, N m s]
  double inner_dashpot = 0;    ///< c1; 0: no internal part [N s/m, N m s]
  double inner_mass = 0;       ///< m; 0: the ground is in its place [kg, kg m2]
  double mass = 0;             ///< m3, which moves with the mat [kg, kg m2]
  double inner_stiffness = 0;  ///< k1; 0: no spring is in series with c1 [N/m, N m]

  /// Whether it is a spring and nothing else.
  bool is_spring() const { return dashpot == 0 && inner_dashpot == 0 && mass == 0; }

  /// Force over motion for motions exp(i omega t), omega in rad/s [N/m, N m].
  std::complex<double> at(double circular_frequency) const;
};

/// Impedances along x, y, z and about x, y, z, uncoupled at the centre of the mat's underside.
using Impedances = std::array<Impedance, 6>;

/// Impedance against one motion b of a mat, a mixture of those along and about the axes: with its
/// elongation e = b . u the mat meets the forces and moments b N.
struct DirectedImpedance {
  std::array<double, 6> motion{};  ///< b, along and about x, y, z
  Impedance impedance;
};

/// Homogeneous elastic half-space.
struct HalfSpace {
  double shear_velocity = 0;  ///< V_s [m/s]
  double density = 0;         ///< rho [kg/m3]
  double poisson = 0;         ///< nu, in [0, 0.5) [-]

  double shear_modulus() const { return density * shear_velocity * shear_velocity; }
  /// Speed of the waves of compression that a mat sends down: V_p, at most 2.5 V_s [m/s].
  double longitudinal_velocity() const;
};

/// Internal mass and its dashpot that make the real part K (1 - share x / (turn + x)) of a
/// stiffness K, where x = a0^2 = (omega length / velocity)^2: c1 = share K t and m = share K t^2,
/// t = length / (velocity sqrt(turn)). The imaginary part is then omega c1 x / (turn + x).
Impedance softening(double stiffness, double share, double turn, double length, double velocity);

}  // namespace pounding
