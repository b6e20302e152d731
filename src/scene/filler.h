#pragma once

#include <vector>

#include "scene/option_row.h"

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

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option("<contact>_filler", text("-:Pa", "none", "strain:pressure,strain:pressure,... or none"), "filler of the joint, foam or board: pressure under first loading, from 0:0 on; hard contact begins at the last strain");
    option(&Filler::unloading, "<contact>_filler_unloading", real("Pa", absent("required with filler"), positive), "filler: slope of pressure over strain on which it unloads and loads again, at least the steepest of the table");
    option(&Filler::thickness, "<contact>_filler_thickness", real("m", absent("left out: the gap"), positive), "filler: its thickness; less than the gap: it begins to press where the rest of the gap is closed");
    option(&Filler::area, "<contact>_filler_area", real("m2", absent("left out: that of the faces"), positive), "filler: its area, shared out to the pairs in proportion to their parts of the face; needed where faces are lines");
    // clang-format on
  }
};

/// A strip of the faces of a contact: elastic up to its strength, which it keeps to its end.
struct Crushing {
  double strength = 0;   ///< [Pa]
  double stiffness = 0;  ///< pressure over closing [N/m3]
  double depth = 0;      ///< [m]
  double area = 0;       ///< [m2]; 0: that of the faces

  double elastic_depth() const { return strength / stiffness; }
  Filler filler() const {
    const std::vector<Filler::Point> table{{elastic_depth() / depth, strength}, {1, strength}};
    return {table, stiffness * depth, depth, area, true};
  }

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option(&Crushing::strength, "<contact>_crushing", real("Pa", absent("left out: the faces are hard"), positive), "faces that are crushed: strength of the strip that gives way where they strike, elastic up to it; hard contact begins where it is crushed to the last");
    option(&Crushing::stiffness, "<contact>_crushing_stiffness", real("N/m3", absent("required with crushing"), positive), "crushing: pressure over closing up to the strength, and on unloading");
    option(&Crushing::depth, "<contact>_crushing_depth", real("m", absent("required with crushing"), positive), "crushing: depth of the strip, of both faces together, that can be crushed before they are hard");
    option(&Crushing::area, "<contact>_crushing_area", real("m2", absent("left out: that of the faces"), positive), "crushing: its area, shared out to the pairs in proportion to their parts of the face; needed where faces are lines");
    // clang-format on
  }
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
