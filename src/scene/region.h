#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "common/types.h"
#include "elements/element_traits.h"
#include "scene/hysteresis.h"
#include "scene/option_row.h"
#include "scene/soil.h"

namespace pounding {

struct Material {
  std::string name;
  double young = 0;    ///< Young's modulus [Pa]
  double poisson = 0;  ///< Poisson's ratio [-]
  double density = 0;  ///< [kg/m3]

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option(&Material::young, "material_<material>_young", real("Pa", required, positive), "Young's modulus");
    option(&Material::poisson, "material_<material>_poisson", real("-", required, open(-1, 0.5)), "Poisson's ratio");
    option(&Material::density, "material_<material>_density", real("kg/m3", required, not_negative), "density; 0: none, for beams and bars, whose mass is that of their length or of points");
    // clang-format on
  }
};

/// Cross-section of a beam. Local x runs along the beam; local z is `z_axis` made orthogonal to x.
struct Section {
  std::string name;
  double area = 0;       ///< [m2]
  double inertia_y = 0;  ///< second moment about local y: bending in the local x-z plane [m4]
  double inertia_z = 0;  ///< second moment about local z: bending in the local x-y plane [m4]
  double torsion = 0;    ///< St-Venant torsion constant [m4]
  Vector3 z_axis{0, 0, 1};
  /// Shear areas for forces along local y and z [m2]; 0: no flexibility in shear.
  double shear_area_y = 0;
  double shear_area_z = 0;

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option("section_<section>_profile", text("name", absent("left out: its own name, if that is one"), "a standard section: HEB160, IPE300, UPN200, W14x132, SHS100x5, HSS8x8x1/2, RECT600x400, ROUND50"), "standard section whose numbers it takes where the next five are left out");
    option(&Section::area, "section_<section>_area", real("m2", required, positive), "area");
    option(&Section::inertia_y, "section_<section>_inertia_y", real("m4", required, positive), "second moment about local y (bending in local x-z)");
    option(&Section::inertia_z, "section_<section>_inertia_z", real("m4", required, positive), "second moment about local z (bending in local x-y)");
    option(&Section::torsion, "section_<section>_torsion", real("m4", required, positive), "St-Venant torsion constant");
    option("section_<section>_shear_area", reals("m2", absent("left out: of its profile, or no flexibility in shear"), "two numbers y,z", positive), "areas that bear shear along local y and along local z");
    option(&Section::z_axis, "section_<section>_z_axis", reals("-", required, "three numbers x,y,z, not all zero"), "direction of local z in global axes");
    // clang-format on
  }
};

/// Rayleigh damping C = alpha M + beta K.
struct Rayleigh {
  double alpha = 0;  ///< [1/s]
  double beta = 0;   ///< [s]
};

/// Extent over which a region spreads its values: at each of its points the whole, or per length of
/// its lines or area of its surfaces.
enum class Spread : std::uint8_t { none, length, area };

/// A physical group of the mesh and the element that the user gives it.
struct Region {
  std::string group;
  ElementType element = ElementType::hex8;
  Material material;
  std::optional<Section> section;  ///< beams
  double resolved_frequency = 0;   ///< beams: the highest of the spectra, see elements/beam2.h
                                   ///< [rad/s]
  /// Beams into which each line of the mesh is cut; 0: as many as its waves need.
  int parts = 1;
  bool at_points = false;            ///< its group is one of the structure's point groups
  double area = 0;                   ///< bars [m2]
  double thickness = 0;              ///< shells [m]
  double rotary_inertia_factor = 0;  ///< shells [-], see elements/flat_shell.h
  double drilling_factor = 1;        ///< of the drilling stiffness of shells [-]
  double added_mass = 0;             ///< shells [kg/m2], beams and bars [kg/m]
  double mass = 0;                   ///< point masses, at each node of the group [kg]
  Vector3 rotary_inertia{0, 0, 0};   ///< point masses [kg m2]
  Vector3 mass_along{1, 1, 1};       ///< parts of their mass that move along x, y, z [-]
  /// Grounded springs: `stiffness` and `dashpot` are per length or area then.
  Spread spread = Spread::none;
  std::array<double, 6> stiffness{};  ///< springs: along and about x, y, z [N/m, N m]
  std::array<double, 6> dashpot{};    ///< springs, of bars the first one [N s/m, N m s]
  bool compression_only = false;      ///< grounded springs: along z they push up only; bars
  NonlinearSpring nonlinear;          ///< springs and bars
  YieldingSection yielding;           ///< beams
  YieldingShell yielding_shell;       ///< shells
  std::optional<Rayleigh> damping;    ///< in place of the structure's
  double stiffness_factor = 1;        ///< which its numbers have already, see scale_stiffness
  double damping_factor = 1;          ///< on its Rayleigh damping, or its part of that of a mode
  /// Displacement [m] and velocity [m/s] of its nodes at t = 0, in place of the structure's.
  std::optional<Vector3> initial_displacement;
  std::optional<Vector3> initial_velocity;
  bool of_water = false;  ///< of a pool: its numbers are there once the mesh is, see fill_pools
  std::optional<Foundation> foundation;  ///< soil: empty until the mesh is read, see lay_foundation

  ElementFamily family() const { return traits_of(element).family; }

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option("<structure>_<group>_element", word(element_words, required), "element of the group (hex8: with incompatible modes)");
    option("<structure>_<group>_points", text("m", absent("left out: the mesh has the group"), "points x,y,z; x,y,z"), "a group that the mesh does not have: the node nearest to each of these points; with an element or without", for_single_nodes);
    option("<structure>_<group>_material", text("name", absent("required but for points, springs and bars of a dashpot alone"), "the name of a material"), "its material", for_extents);
    option("<structure>_<group>_section", text("name", absent("required for beam"), "the name of a section"), "its cross-section (beam only)", for_beams);
    option("<structure>_<group>_divide", text("-", "none", "none, auto, or a count from 2 to 1000"), "lines of the mesh are cut into so many beams of one length; auto: into as many as bending up to the highest of spectra_frequencies needs, 4 in a half wave", for_beams);
    option("<structure>_<group>_area", real("m2", absent("required for bar, unless it is a dashpot alone"), positive), "its cross-section area (bar only)", for_bars);
    option("<structure>_<group>_tension_only", flag(false), "bar that buckles: it resists stretching only", for_bars);
    option(&Region::thickness, "<structure>_<group>_thickness", real("m", absent("required for shell"), positive), "its thickness (shell only)", for_shells);
    option(&Region::rotary_inertia_factor, "<structure>_<group>_rotary_inertia_factor", real("-", "0", not_negative), "shell: rotary inertia of a node at least its mass x this x element area; 0.125 frees the step from thin shells", for_shells);
    option(&Region::drilling_factor, "<structure>_<group>_drilling_factor", real("-", "1", positive), "shell: stiffness against turning about the normal, over G t; 0.1 is closer and has a longer step", for_shells);
    option(&Region::added_mass, "<structure>_<group>_mass_per_area", real("kg/m2", "0", not_negative), "load on a shell with mass and no stiffness", for_shells);
    option(&Region::added_mass, "<structure>_<group>_mass_per_length", real("kg/m", "0", not_negative), "load on a beam or bar with mass and no stiffness", for_beams_and_bars);
    option(&Region::mass, "<structure>_<group>_mass", real("kg", absent("required for point_mass"), positive), "mass added at each point of the group", for_points);
    option(&Region::rotary_inertia, "<structure>_<group>_rotary_inertia", reals("kg m2", "0,0,0", "three numbers about x, y, z", not_negative), "point_mass: its rotary inertia", for_points);
    option("<structure>_<group>_stiffness", reals("N/m, N m", absent("required for springs"), "six numbers along and about x, y, z (three: no rotations)", not_negative), "of grounded_spring and spring", for_springs);
    option("<structure>_<group>_dashpot", reals("N s/m, N m s", "0,0,0,0,0,0", "six numbers along and about x, y, z (bar: one)", not_negative), "dashpot beside the spring, of a bar along its line", for_bars_and_springs);
    option("<structure>_<group>_stiffness_per_area", reals("N/m3", "0,0,0", "three numbers along x, y, z", not_negative), "grounded_spring on surfaces: its stiffness per area", for_grounded);
    option("<structure>_<group>_dashpot_per_area", reals("N s/m3", "0,0,0", "three numbers along x, y, z", not_negative), "grounded_spring on surfaces: its dashpots per area", for_grounded);
    option("<structure>_<group>_stiffness_per_length", reals("N/m2", "0,0,0", "three numbers along x, y, z", not_negative), "grounded_spring on lines: its stiffness per length", for_grounded);
    option("<structure>_<group>_dashpot_per_length", reals("N s/m2", "0,0,0", "three numbers along x, y, z", not_negative), "grounded_spring on lines: its dashpots per length", for_grounded);
    option("<structure>_<group>_compression_only", flag(false), "grounded_spring from which a mat may lift off: along z, spring and dashpot resist pressing down only; or a bar that resists shortening only", for_bars_and_grounded);
    option("<structure>_<group>_dashpot_exponent", real("-", "1", closed(0.01, 2)), "power of the rate to which its dashpots go; their unit is N (s/m)^it", for_bars_and_springs);
    option("<structure>_<group>_dashpot_stiffness", reals("N/m, N m", "0,0,0,0,0,0", "six numbers along and about x, y, z (bar: one)", not_negative), "spring in series with each dashpot; 0: none, it is rigid", for_bars_and_springs);
    option("<structure>_<group>_series_stiffness", reals("N/m, N m", "0,0,0,0,0,0", "six numbers along and about x, y, z", not_negative), "spring in series with its spring and dashpot together; 0: none, it is rigid", for_springs);
    // clang-format on
    describe_laws(option);
  }

  /// Options of laws and of damping; and how the group starts.
  static void describe_laws(auto& option) {
    using namespace option_words;
    // clang-format off
    option("<structure>_<group>_yield_force", reals("N, N m", "0", "one number (bar), or three or six along and about x, y, z", not_negative), "force at which it yields; 0: never", for_bars_and_springs);
    option("<structure>_<group>_hardening", real("-", "0", below_1), "stiffness after yield over that before", for_bars_and_springs);
    option("<structure>_<group>_rule", word(rule_words, "kinematic"), "way back from the skeleton and towards it again of a spring or bar that yields, see docs/reference/nonlinear.md", for_bars_and_springs);
    option("<structure>_<group>_skeleton", reals("m, N", absent("left out: yield_force and hardening"), "pairs e1,f1,e2,f2,...", not_negative), "corners of force over elongation (of a bar: over its strain), the first one on the line of the stiffness, the last one followed by hardening", for_bars_and_springs);
    option("<structure>_<group>_skeleton_back", reals("m, N", absent("left out: as skeleton"), "pairs e1,f1,e2,f2,..., or 0", not_negative), "corners in the other direction; 0: it carries nothing there and leaves a gap", for_bars_and_springs);
    option("<structure>_<group>_shear_skeleton_y", reals("-, N", absent("left out: elastic"), "pairs g1,Q1,g2,Q2,...", not_negative), "beam that yields in shear: corners of the force along local y over the shear strain, the first one on the line of G A", for_beams);
    option("<structure>_<group>_shear_skeleton_z", reals("-, N", absent("left out: elastic"), "pairs g1,Q1,g2,Q2,...", not_negative), "likewise along local z", for_beams);
    option("<structure>_<group>_shear_skeleton", reals("-, Pa", absent("left out: elastic"), "pairs g1,t1,g2,t2,...", not_negative), "shell that yields in shear in its plane: corners of the shear stress over the shear strain, the first one on the line of G", for_shells);
    option("<structure>_<group>_shear_rule", word(rule_words, "straight"), "its rule, see rule", for_beams_and_shells);
    option("<structure>_<group>_bending_skeleton_y", reals("1/m, N m", absent("left out: elastic"), "pairs k1,M1,k2,M2,...", not_negative), "beam that yields in bending: corners of the moment about local y over the curvature, the first one on the line of E I", for_beams);
    option("<structure>_<group>_bending_skeleton_z", reals("1/m, N m", absent("left out: elastic"), "pairs k1,M1,k2,M2,...", not_negative), "likewise about local z", for_beams);
    option("<structure>_<group>_bending_rule", word(rule_words, "bending"), "its rule, see rule", for_beams);
    option("<structure>_<group>_bending_axial", reals("N, -", absent("left out: none"), "N_y or N_y,a", positive), "an axial force N leaves 1 - (|N| / N_y)^a of the strength in bending, a 1 unless given; with bending_rule kinematic", for_beams);
    option.template part<ShellCracking>();
    option("<structure>_<group>_unloading_exponent", real("-", absent("left out: 0, of bending 0.5"), up_to_1), "peak, pinching, bending: stiffness of unloading over the first one is this power of the secant over it", for_yielding);
    option("<structure>_<group>_unloading_least", real("-", "0", up_to_1), "peak, pinching, bending, origin: least stiffness of unloading over the first one", for_yielding);
    option("<structure>_<group>_pinch", reals("-", absent("required with pinching"), "two numbers force,way", up_to_1), "pinching: corner on the way to the farthest point, as parts of its force and of the way there", for_yielding);
    option("<structure>_<group>_deterioration", reals("J, -", absent("left out: none"), "energy, or energy,exponent", positive), "peak, pinching: energy that it can lose before its strength is gone (of a bar per length), and exponent of its going", for_yielding);
    option("<structure>_<group>_yield_circle", word("none|x+y|y+z|x+z", "none"), "translations that yield together: a bearing's shear", for_springs);
    option("<structure>_<group>_sliding_friction", real("-", "0", up_to_10), "sliding bearing: the circle yields at this times the compression across it", for_springs);
    option("<structure>_<group>_pendulum_radius", real("m", "0", not_negative), "friction pendulum: radius of its dish, whose slope follows the compression; hardening bounds it; 0: hardening is the slope", for_springs);
    option("<structure>_<group>_slack", real("m", "0", not_negative), "tension_only or compression_only bar: stretched or shortened so far before it acts (a hook, a cable that sags; a gap)", for_bars);
    option("<structure>_<group>_damping_alpha", real("1/s", absent("left out: that of the structure"), not_negative), "Rayleigh damping of its elements, mass term");
    option("<structure>_<group>_damping_beta", real("s", absent("left out: that of the structure"), not_negative), "Rayleigh damping of its elements, stiffness term");
    option("<structure>_<group>_damping_ratio", real("-", absent("optional"), damping_ratio), "instead of alpha and beta: damping ratio at two frequencies");
    option("<structure>_<group>_damping_frequencies", reals("Hz", absent("required with the ratio"), "two numbers f1,f2", positive), "the two frequencies of the damping ratio");
    option(&Region::stiffness_factor, "<structure>_<group>_stiffness_factor", real("-", "1", positive), "factor on its stiffness, as of cracked walls; its strengths stay", for_stiff);
    option(&Region::damping_factor, "<structure>_<group>_damping_factor", real("-", "1", not_negative), "factor on its damping: on alpha and beta; in modes on its part of their damping, by strain energy");
    option(&Region::initial_displacement, "<structure>_<group>_initial_displacement", reals("m", absent("left out: that of the structure"), "three numbers x,y,z"), "of every free node of the group at t = 0");
    option(&Region::initial_velocity, "<structure>_<group>_initial_velocity", reals("m/s", absent("left out: that of the structure"), "three numbers x,y,z"), "of every free node of the group at t = 0");
    // clang-format on
  }
};

/// Beams that bend by shear as well.
inline bool is_flexible_in_shear(const Region& region) {
  return region.element == ElementType::beam && region.section->shear_area_y > 0;
}

}  // namespace pounding
