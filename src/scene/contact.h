#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "common/series.h"
#include "common/types.h"
#include "scene/filler.h"
#include "scene/option_row.h"

namespace pounding {

/// One side of a contact: a physical group (surface or shell edge) of a structure, or a rigid wall
/// that follows the ground (structure "wall", primary side only). Of a stop the nodes of a group.
struct ContactSide {
  std::string structure;
  std::string group;
  bool is_wall() const { return structure == "wall"; }
};

/// A part of a face, on the tangent axes, where the joint has a gap of its own: debris or formwork
/// left in.
struct GapPatch {
  std::array<double, 2> low{};   ///< corner of a rectangle, or the middle of a disc [m]
  std::array<double, 2> high{};  ///< corner beyond it, or the same middle [m]
  double radius = 0;             ///< of a disc [m]; 0: a rectangle
  double gap = 0;                ///< in place of all that the joint has elsewhere [m]

  /// Whether a place on the tangent axes [m] is in it; its border is.
  bool holds(const std::array<double, 2>& place) const {
    if (radius > 0) return std::hypot(place[0] - low[0], place[1] - low[1]) <= radius;
    return low[0] <= place[0] && place[0] <= high[0] && low[1] <= place[1] && place[1] <= high[1];
  }
};

/// Closing of a joint by elevation, straight between points that rise and even beyond them.
struct StaticClosing {
  std::vector<double> elevations;  ///< [m]; empty: none
  std::vector<double> closings;    ///< [m]

  double at(double elevation) const {
    return elevations.empty() ? 0 : interpolated(elevations, closings, elevation);
  }
};

/// Initial gap: from the geometry, one number, two values (linear along the first tangent axis) or
/// four (the corners of the face, going round). Tangent axes: the global axes other than the one
/// closest to the contact normal, in the order x, y, z. Corners: (min t1, min t2), (max t1, min
/// t2), (max t1, max t2), (min t1, max t2).
struct InitialGap {
  std::vector<double> values;     ///< empty: from geometry; else 1, 2 or 4 values [m]
  double deviation = 0;           ///< of a random part over the face [m]; 0: none
  double length = 1;              ///< over which that part is correlated [m]
  int seed = 1;                   ///< of that part
  std::vector<GapPatch> patches;  ///< of two that share a place the last counts
  std::string survey;             ///< file of gaps measured, in place of `values`; empty: none
  /// Closing by which the joint is narrower before the run, without patches.
  StaticClosing static_closing;

  bool has_deviation() const { return deviation > 0; }
  /// Whether the gap is that of the meshes.
  bool is_of_meshes() const { return values.empty() && survey.empty(); }

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option("<contact>_gap", text("m", "geometry", "geometry, or one, two or four numbers g1,g2,..."), "initial gap: uniform, linear, or at the four corners");
    option(&InitialGap::deviation, "<contact>_gap_deviation", real("m", "0", not_negative), "standard deviation of a random part of the gap over the face, as tolerances of building make it; 0: none");
    option(&InitialGap::length, "<contact>_gap_length", real("m", absent("required with gap_deviation"), positive), "length over which that part is correlated: its covariance falls with exp(-distance/length)", needs(&InitialGap::has_deviation));
    option(&InitialGap::seed, "<contact>_gap_seed", integer("-", "1"), "seed of that part: another number, another joint of the same tolerances", needs(&InitialGap::has_deviation));
    option("<contact>_gap_patches", text("m", "none", "none, or discs s,t,radius,gap and rectangles s1,t1,s2,t2,gap between semicolons"), "parts of the face with a gap of their own, in place of all others, as debris or formwork left in makes them; s and t are places along the tangent axes, in the order x, y, z, and a gap of 0 is a joint that is filled");
    option(&InitialGap::survey, "<contact>_survey", text("file", "none", "a file or none"), "the joint as it was measured, in place of gap: a table with a first line of names, x, y, z and gap, in metres, and where several contacts are in it contact, their names; linear between the points, beyond them as at the nearest place");
    option("<contact>_static_closing", text("m", "none", "none, or elevation:closing,..."), "by which the joint is narrower at the start than gap or survey have it, as temperature, creep and settlement make it: straight between elevations, even beyond them; below 0: wider");
    // clang-format on
  }
};

/// Makes a contact a stop between nodes of its sides.
struct Stop {
  /// Unit vector along which the primary lies beyond the secondary; nothing: the line between them.
  std::optional<Vector3> along;
  double stiffness = 0;  ///< beyond the gap, of each pair of nodes [N/m]; 0: it is hard
  double dashpot = 0;    ///< beside that, while it presses [N s/m]

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option("<contact>_along", text("-", absent("left out: the sides are faces"), "a direction x,y,z, or line"), "stop between nodes: its sides are nodes, groups of them or points structure:x,y,z; x,y,z, and this is the direction in which the primary lies beyond the secondary; line: that from one to the other. Two gaps stop both ways: until they have come together by the first, and parted by the second");
    option(&Stop::stiffness, "<contact>_stiffness", real("N/m", absent("left out: it is hard"), positive), "stop: spring beyond its gap, between each two nodes");
    option(&Stop::dashpot, "<contact>_dashpot", real("N s/m", "0", not_negative), "stop with a stiffness: dashpot beside it, while both press");
    // clang-format on
  }
};

struct Contact {
  std::string name;
  ContactSide secondary;
  ContactSide primary;
  InitialGap gap;
  int passes = 1;                ///< 2: the nodes of the primary side are constrained as well;
                                 ///< 0: where the faces ask for it
  bool gap_at_rest = false;      ///< the gap is that of the rest that the run starts from
  bool gap_assumed_so = false;   ///< that follows from the gap, it was not given
  double friction = 0;           ///< Coulomb's coefficient [-]
  double sliding = 0;            ///< how far the faces may slide along each other, pairs being
                                 ///< found anew; 0: pairs stay those of the start [m]
  std::optional<Filler> filler;  ///< between the faces until they meet, or a strip of them
  std::optional<Stop> stop;      ///< its sides are nodes, not faces: one gap, or one each way

  /// A stop that gives way: its rows are springs, and none of hard contact.
  bool is_elastic() const { return stop && stop->stiffness > 0; }
  /// A strip of its faces is crushed where they strike.
  bool crushes() const { return filler && filler->in_faces; }

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option("<contact>_secondary", text("group", required, "structure:group"), "secondary side, a surface of a structure");
    option("<contact>_primary", text("group", required, "structure:group, or wall"), "primary side, the surface that it faces; wall: rigid, parallel to the secondary");
    option.template part<InitialGap>();
    option("<contact>_gap_at", word("auto|rest|unloaded", "auto"), "with preload static: the state in which the joint has its gap, at rest under the weight or unloaded as the meshes are; auto: at rest where the gap is given and positive everywhere, not beside a wall");
    option(&Contact::passes, "<contact>_passes", word("auto|1|2", "auto"), "2: nodes of the primary side are kept out of the secondary as well; auto: where either side holds lines, or the facets of the secondary are larger");
    option(&Contact::friction, "<contact>_friction", real("-", "0", up_to_10), "Coulomb's coefficient of friction; 0: smooth");
    option(&Contact::sliding, "<contact>_sliding", real("m", "0", not_negative), "how far the two faces may slide along each other: pairs are found anew as they do; 0: pairs stay those of the start");
    option.template part<Filler>();
    option.template part<Crushing>();
    option.template part<Stop>();
    // clang-format on
  }
};

}  // namespace pounding
