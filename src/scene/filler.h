#pragma once

#include <vector>

namespace pounding {

/// Filler of a joint, foam, board or rubber between two faces, as the user gives it: its pressure
/// under first loading, straight between points and from (0, 0) on, and the slope on which it
/// unloads and loads again. It pushes only, and stays crushed. Or a strip of the faces themselves
/// that is crushed where they strike.
struct Filler {
  struct Point {
    double strain = 0;    ///< of compression [-]
    double pressure = 0;  ///< [Pa]
  };
  std::vector<Point> table;  ///< strains increasing, pressures not falling; at least one
  double unloading = 0;      ///< pressure over strain, no slope of the table is above it [Pa]
  double thickness = 0;      ///< [m]; 0: the joint's width at each pair
  double area = 0;           ///< of all pairs together [m2]; 0: that of the faces
  bool in_faces = false;     ///< a strip of the faces: the joint is as wide as without it

  /// Strain at which it is dense: the faces are in hard contact there.
  double dense() const { return table.back().strain; }
  /// Stiffness of a pair with its thickness [m] and area [m2], at its stiffest [N/m].
  double stiffness(double of_thickness, double of_area) const {
    return unloading * of_area / of_thickness;
  }
  /// Steepest slope of the table [Pa].
  double steepest() const;
};

inline double Filler::steepest() const {
  Point before;
  double slope = 0;
  for (const Point& point : table) {
    const double here = (point.pressure - before.pressure) / (point.strain - before.strain);
    if (here > slope) slope = here;
    before = point;
  }
  return slope;
}

}  // namespace pounding
