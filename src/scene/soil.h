#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/types.h"
#include "elements/element_properties.h"
#include "scene/option_row.h"
#include "soil/foundation.h"

namespace pounding {

/// Misfit of the worst term of some coupled motions over its diagonals, as a file states it.
struct FitMisfit {
  std::string motions;    ///< "x, ry", of several mats "x1, ry1, x2"
  double largest = 0;     ///< over the frequencies [-]
  double largest_at = 0;  ///< its frequency [Hz]
  double mean = 0;        ///< over the frequencies [-]

  static void members(auto& self, auto& stream) {
    stream(self.motions, self.largest, self.largest_at, self.mean);
  }
};

/// Impedance against one motion of one or several mats, as DirectedImpedance.
struct SoilPart {
  std::vector<double> motion;  ///< along and about x, y, z, mat by mat
  Impedance impedance;

  static void members(auto& self, auto& stream) { stream(self.motion, self.impedance); }
};

/// Springs, dashpots and masses of a file of soil.
struct FittedSoil {
  std::vector<DirectedImpedance> parts;  ///< of the mat alone; they act side by side
  std::vector<FitMisfit> misfits;
  int mats = 1;  ///< that the file is for
  /// All that acts between several mats beside the springs `parts` of each: springs between two of
  /// them, whose stiffness may be negative, and all dashpots, masses and hidden motions.
  std::vector<SoilPart> shared;
};

/// Soil under the rigid mat of a structure, as the user gives it: a half-space, or a file.
struct Soil {
  std::string mat;  ///< physical group of its nodes
  HalfSpace ground;
  bool disk = false;
  std::optional<std::array<double, 2>> sides;  ///< full, along x and y [m]; empty: the group's own
  double embedment = 0;                        ///< [m]
  bool frequency_dependence = true;
  double factor = 1;  ///< on the ground's shear modulus, which its numbers have already
  std::string table;  ///< file; empty: a half-space
  int table_mat = 1;  ///< mat of the file, from 1 on
  std::optional<FittedSoil> fitted;  ///< once the file is read; see read_soil_file

  static constexpr std::string_view no_half_space =
      "is of a half-space, and -<structure>_soil_table gives soil in its place; leave one of them "
      "out";
  static constexpr std::string_view no_table = "is of a -<structure>_soil_table; leave it out";
  bool is_half_space() const { return table.empty(); }
  bool is_fitted() const { return !table.empty(); }
  bool is_shared() const { return fitted && fitted->mats > 1; }

  static void describe(auto& option) {
    using namespace option_words;
    const auto half_space = needs(&Soil::is_half_space, no_half_space);
    // clang-format off
    option(&Soil::mat, "<structure>_soil_mat", text("group", "none", "a physical group or none"), "rigid mat on soil: its node nearest to the middle of the group carries springs, dashpots and internal masses of a half-space");
    option(&Soil::table, "<structure>_soil_table", text("file", "none", "a file of run/soil or none"), "soil: springs, dashpots, masses and hidden motions of the mat, in place of those of a half-space, as run/soil fits them to impedances over the frequency");
    option(&Soil::table_mat, "<structure>_soil_table_mat", integer("-", "1", at_least_1), "soil: which mat of a table of several it is, in the table's order; each is that of another structure", needs(&Soil::is_fitted, no_table));
    option(&Soil::ground, &HalfSpace::shear_velocity, "<structure>_soil_vs", real("m/s", absent("required with soil_mat, unless there is a soil_table"), positive), "soil: speed of shear waves", half_space);
    option(&Soil::ground, &HalfSpace::density, "<structure>_soil_density", real("kg/m3", absent("required with soil_mat, unless there is a soil_table"), positive), "soil: density", half_space);
    option(&Soil::ground, &HalfSpace::poisson, "<structure>_soil_poisson", real("-", absent("required with soil_mat, unless there is a soil_table"), half_open(0, 0.5)), "soil: Poisson's ratio", half_space);
    option(&Soil::disk, "<structure>_soil_shape", word("rectangle|disk", "rectangle"), "soil: shape of the mat's underside", half_space);
    option("<structure>_soil_size", reals("m", absent("left out: that of the group"), "two sides along x and y, or a diameter", positive), "soil: size of the mat's underside");
    option(&Soil::embedment, "<structure>_soil_embedment", real("m", "0", not_negative), "soil: depth of the underside of a rectangle below the surface", half_space);
    option(&Soil::frequency_dependence, "<structure>_soil_frequency_dependence", flag(true), "soil: internal masses; without them static springs, and dashpots of a0 = 1", half_space);
    option(&Soil::factor, "<structure>_soil_factor", real("-", "1", positive), "soil: factor on its shear modulus at one density: its springs times the factor, dashpots times its root, masses as they are");
    // clang-format on
  }
};

/// Outline of a mat in its mesh.
struct MatOutline {
  Vector3 node{0, 0, 0};          ///< position of the node that carries the soil [m]
  Vector3 centre{0, 0, 0};        ///< of the underside [m]
  std::array<double, 2> sides{};  ///< of the box around the group along x and y [m]
};

/// Soil under a mat as the mesh places it: springs of an element of one node, and links.
struct Foundation {
  Footprint footprint;                        ///< of a half-space
  Vector3 centre{0, 0, 0};                    ///< of the underside, where the impedances act [m]
  std::vector<DirectedImpedance> impedances;  ///< about the centre
  std::vector<GroundSpring> springs;          ///< likewise, of the node over the arm
};

/// Sides of a mat's underside along x and y [m]: as given, or the group's own; of a disk both are
/// the shorter one.
std::array<double, 2> sides_of(const Soil& soil, const MatOutline& outline);

/// Motion of a node from a motion of a mat's middle, `arm` [m] from the node; both along and about
/// x, y, z.
std::array<double, 6> over_arm(std::span<const double> motion, const Vector3& arm);

/// Foundation of a mat on its soil.
Foundation foundation_of(const Soil& soil, const MatOutline& outline);

}  // namespace pounding
