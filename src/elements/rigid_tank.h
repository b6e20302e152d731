#pragma once

#include <vector>

/// Water in a rigid rectangular tank whose floor is level: masses by which it acts on the tank that
/// moves along one of its sides. Linear potential flow, no pressure on the surface but the waves'
/// own (Graham and Rodriguez, J. Appl. Mech. 19 (1952); Housner, Bull. Seism. Soc. Am. 53 (1963)).
namespace pounding {

/// Mass of the water that moves as a body: with the tank, or on a spring against it.
struct WaterMass {
  double mass = 0;                ///< over that of all water [-]
  double height = 0;              ///< of its force on the walls, over the depth [-]
  double height_with_floor = 0;   ///< likewise, with the moment of the pressure on the floor [-]
  double circular_frequency = 0;  ///< against the tank; 0: with it [rad/s]
  double wave = 0;  ///< height at the wall per displacement of the mass against the tank [-]
};

/// Water along one side of a tank.
struct TankWater {
  WaterMass impulsive;  ///< with the tank
  /// Antisymmetric sloshing modes n = 1, 3, 5, ..., the lowest first. The last one has the mass of
  /// all that are left out as well, so that mass and moment of a static acceleration are complete.
  std::vector<WaterMass> convective;
};

/// Masses of water of a depth [m] in a tank of a length [m] along its motion, `modes` >= 1 of them
/// convective, under gravity [m/s2]. With a = n pi depth / length, over the mass of the water,
///
///     m_n = 8 tanh a / ((n pi)^3 depth / length),     omega_n^2 = n pi gravity tanh a / length
///     h_n / depth = 1 - tanh(a / 2) / a,              with the floor + 1 / (a sinh a)
///
/// and the rest of the mass and of its moment is impulsive. Sums of infinitely many
/// modes are closed: those of 1 / n^3 and 1 / n^4, less terms that fall as exp(-a).
TankWater water_in_tank(double depth, double length, double gravity, int modes);

/// Impulsive pressure on a wall at a height over the floor that is a part of the depth, over the
/// largest possible one, density x acceleration x depth.
double impulsive_pressure(double height, double depth, double length);

}  // namespace pounding
