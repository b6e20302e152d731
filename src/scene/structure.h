#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/types.h"
#include "scene/law_kinds.h"
#include "scene/option_row.h"
#include "scene/pool.h"
#include "scene/soil.h"
#include "scene/uniform_damping.h"

namespace pounding {

/// A structure represented by its lowest modes and by attachment vectors.
struct ModalModel {
  int modes = 0;           ///< number of modes; 0: all below the cut-off
  int candidates = 0;      ///< number of lowest modes to choose them from; 0: no others
  double cutoff = 0;       ///< [Hz]
  bool attachment = true;  ///< static responses to unit forces at the contact dofs as well
  bool residual = true;    ///< and to the motion of the ground
  int patches = 0;         ///< or to forces on so many patches of them; 0: on every one
  std::vector<double> damping_ratios;  ///< of mode 1, 2, ..., the last one of all that follow;
                                       ///< empty: the structure's Rayleigh damping
  std::string basis_file;              ///< where the basis is kept; empty: nowhere
  int ranks = 1;                       ///< that compute the basis together, if there are so many
  /// Part of the largest energy that may lie outside the basis where a structure goes to modes [-];
  /// 0 of one that is in modes throughout.
  double switched_part = 0;

  bool is_switched() const { return switched_part > 0; }
  bool is_lasting() const { return !is_switched(); }
  bool counts() const { return modes > 0; }
  bool counts_none() const { return modes == 0; }
  bool attaches() const { return attachment; }

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option(&ModalModel::modes, "<structure>_modal_vectors", integer("-", absent("this or the cut-off"), at_least_1), "modal: number of modes, the lowest ones");
    option(&ModalModel::candidates, "<structure>_modal_candidates", integer("-", absent("as many as modes"), at_least_1), "modal: number of lowest modes computed, of which as many as wanted are kept: the lowest, and those that move the contact points most", needs(&ModalModel::counts, "goes with -<structure>_modal_vectors, which is not given"));
    option(&ModalModel::cutoff, "<structure>_modal_cutoff", real("Hz", absent("this or the number"), positive), "modal: every mode below this frequency", needs(&ModalModel::counts_none, "give either this or -<structure>_modal_vectors, not both"));
    option(&ModalModel::attachment, "<structure>_modal_attachment", flag(true), "modal: static responses to unit forces at the contact dofs beside the modes", needs(&ModalModel::is_lasting));
    option(&ModalModel::residual, "<structure>_modal_residual", flag(true), "modal: static responses to the motion of the ground beside the modes (residual vectors, missing mass)");
    option(&ModalModel::ranks, "<structure>_modal_ranks", integer("-", "1", at_least_1), "modal: ranks that compute its basis together; more than one need a file for it");
    option(&ModalModel::patches, "<structure>_modal_patches", integer("-", "0", closed(0, 10000)), "modal: attachment vectors of so many patches of contact points in place of one each; 0: one each", needs(&ModalModel::attaches, "not with -<structure>_modal_attachment false"));
    option(&ModalModel::damping_ratios, "<structure>_modal_damping", reals("-", absent("left out: that of the structure"), "a comma-separated list of numbers", damping_ratio), "modal: damping ratio of mode 1, 2, ..., the last one for all that follow and for vectors that are no mode");
    option(&ModalModel::basis_file, "<structure>_modal_basis", text("file", "none", "a file or none"), "modal: where the basis is kept, to be used again while the structure stays the same");
    option(&ModalModel::switched_part, "<structure>_switched_part", real("-", "1e-6", closed(0, .01)), "switched: part of the structure's largest energy outside its basis below which it goes to modes; 0: full order throughout", needs(&ModalModel::is_switched, "goes with -<structure>_model switched, which is not given"));
    // clang-format on
  }
};

/// A physical group fixed to the ground.
struct Clamp {
  std::string group;
  std::uint8_t components = 0x3f;  ///< one bit each: 0-2 translations, 3-5 rotations
};

/// A stable time step that is wanted, and its largest cost.
struct StepTarget {
  double time_step = 0;  ///< [s]
  double change = 0;     ///< largest part by which a frequency may fall [-]
  double frequency = 0;  ///< of those up to here, which count [Hz]
  double shells = 0;     ///< step [s] that shells get rotational inertia for; 0: none

  bool is_wanted() const { return time_step > 0; }

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option(&StepTarget::time_step, "<structure>_time_step_target", real("s", "0", not_negative), "stable time step to be reached by mass scaling and by rotational inertia of shells, as far as its frequencies allow; 0: none");
    option(&StepTarget::change, "<structure>_target_change", real("-", "1e-3", fraction), "time step target: part by which a frequency may fall", needs(&StepTarget::is_wanted, "goes with -<structure>_time_step_target"));
    option(&StepTarget::frequency, "<structure>_target_frequency", real("Hz", "50", positive), "time step target: frequencies up to this one count", needs(&StepTarget::is_wanted, "goes with -<structure>_time_step_target"));
    // clang-format on
  }
};

/// How nodes move together.
enum class RigidKind : std::uint8_t {
  body,       ///< a physical group, as one rigid body
  diaphragm,  ///< level floors, each rigid in its plane
  join,       ///< each node of a group and the nearest one of another, as a rigid body
  pin,        ///< nodes of a group that lie on each other, in their displacements
  level,      ///< nodes of a group at one height, in their displacements
  tie         ///< nodes of a group follow the nearest facet of another
};

/// A physical group that moves together.
struct RigidGroup {
  RigidKind kind = RigidKind::body;
  std::string group;
  std::string other;     ///< of a join or tie: where the nearest node or facet is looked for; of a
                         ///< body: nodes that follow it in some components
  bool implied = false;  ///< a mat on soil: nobody asked, and it may be part of a larger body
  /// Components in which nodes of the other group follow a body, or its own where there is no
  /// other; one bit each.
  std::uint8_t following = 0x3f;

  std::string name() const { return other.empty() ? group : group + ":" + other; }
  /// Components that follow one rigid motion, one bit each; not given for ties.
  std::uint8_t components() const {
    if (kind == RigidKind::diaphragm) return 0x23;
    return kind == RigidKind::pin || kind == RigidKind::level ? 0x07 : 0x3f;
  }
};

/// The option that makes a group move together.
inline const char* rigid_option(RigidKind kind) {
  constexpr const char* options[] = {"<structure>_rigid",  "<structure>_diaphragm",
                                     "<structure>_join",   "<structure>_pin",
                                     "<structure>_levels", "<structure>_tie"};
  return options[static_cast<int>(kind)];
}

/// A group that the mesh does not have: its nodes nearest to some points.
struct PointGroup {
  std::string name;
  std::string option;  ///< that gives the points, for messages
  std::vector<Vector3> points;
};

/// Faces of solids through which waves leave a structure, see mesh/global_mesh.h.
struct AbsorbingFace {
  std::string group;
  bool is_base = false;  ///< the motion from below enters through it
};

/// How the numbers of hexahedra of general shape are kept.
enum class Numbers { in_double, in_single };

struct Structure {
  std::string name;
  std::string matrices;  ///< folder, see system/matrix_system.h; empty: of its elements
  std::string mesh;      ///< .geo or .msh
  std::vector<std::pair<std::string, std::string>> mesh_set;  ///< parameters of a .geo
  std::vector<PointGroup> point_groups;                       ///< beside those of the mesh
  std::vector<std::string> ignored_groups;                    ///< of the mesh, left out on purpose
  bool allow_loose = false;  ///< pieces and coincident nodes that nothing joins
  std::vector<Clamp> clamps;
  std::vector<RigidGroup> rigid_groups;
  std::vector<AbsorbingFace> absorbing;
  std::vector<Region> regions;
  Rayleigh damping;
  std::optional<UniformDamping> uniform_damping;  ///< in place of Rayleigh damping, which is 0 then
  std::optional<ModalModel> modal;                ///< nothing: the finite-element model itself
  std::optional<ModalModel> switched;     ///< likewise, in these modes while nothing strikes it
  std::optional<Soil> soil;               ///< under its mat; one of the regions is its element
  std::vector<Pool> pools;                ///< the last of the regions are their water
  Numbers numbers = Numbers::in_double;   ///< K is that of the rounded numbers
  bool p_delta = false;                   ///< forces at rest turn with the columns
  double mass_scaling = 0;                ///< step [s] for which stiff elements get mass; 0: none
  std::optional<StepTarget> step_target;  ///< its step is `mass_scaling` until one is designed
  Vector3 initial_displacement{0, 0, 0};  ///< of every free node [m]
  Vector3 initial_velocity{0, 0, 0};      ///< of every free node [m/s]
  std::string initial_state;              ///< file of those of single nodes; empty: none
  Vector3 gravity{0, 0, 0};               ///< constant body acceleration [m/s2]

  /// The basis that it needs; null where it needs none.
  const ModalModel* basis() const { return modal ? &*modal : switched ? &*switched : nullptr; }
  /// Some node starts away from its place, or in motion; a file may say either.
  bool starts_displaced() const {
    return initial_displacement != Vector3{0, 0, 0} || !initial_state.empty() ||
           std::ranges::any_of(regions, [](const Region& region) {
             return region.initial_displacement.has_value();
           });
  }
  bool starts_in_motion() const {
    return initial_velocity != Vector3{0, 0, 0} || !initial_state.empty() ||
           std::ranges::any_of(
               regions, [](const Region& region) { return region.initial_velocity.has_value(); });
  }
  /// Bound of the factor on K for the fastest motions [-].
  double stiffening() const { return uniform_damping ? uniform_damping->at_once() : 1; }
  /// The motion enters it as a wave from below.
  bool is_driven_from_below() const {
    return std::ranges::any_of(absorbing, &AbsorbingFace::is_base);
  }
  /// The damping of a region's elements.
  Rayleigh damping_of(const Region& region) const {
    const Rayleigh own = region.damping.value_or(damping);
    return {region.damping_factor * own.alpha, region.damping_factor * own.beta};
  }
  /// A factor on the stiffness of its elements is one on its whole K: neither soil, waves nor the
  /// forces at rest that turn with its columns have a part in it.
  bool scales_as_a_whole() const { return !soil && pools.empty() && !p_delta; }

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option(&Structure::mesh, "<structure>_mesh", text("file", required, "a .geo or .msh file"), "geometry to mesh (.geo) or mesh");
    option("<structure>_mesh_set", text("pairs", "none", "name=value,name=value or none"), "parameters of the .geo file");
    option("<structure>_clamp", names("none"), "physical groups fixed to the ground, in some components only as group:y+rx+rz");
    option("<structure>_rigid", names("none"), "physical groups that move as one rigid body each; group:x+y+z: in these components alone; hub:group:x+y+z: all of hub, and these components of the nodes of the other group");
    option("<structure>_diaphragm", names("none"), "physical groups of level floors, each rigid in its plane and free to bend out of it");
    option("<structure>_join", names("none", "pairs", "group:group,group:group or none"), "each node of the first group and the nearest one of the second become a rigid body: beams below the slabs that they carry");
    option("<structure>_pin", names("none"), "physical groups whose nodes that lie on each other share their displacements, and turn on their own");
    option("<structure>_levels", names("none"), "physical groups whose nodes at one height share their displacements: sides of a block of soil that move as the free field");
    option("<structure>_absorbing", names("none"), "physical groups of faces of solids through which waves leave: dashpots density x speed x area");
    option("<structure>_absorbing_base", names("none"), "absorbing faces through which the motion enters from below (motion_input below)");
    option("<structure>_tie", names("none", "pairs", "group:group,group:group or none"), "each node of the first group follows the nearest facet of the second, or edge: parts whose meshes do not match");
    option(&Structure::ignored_groups, "<structure>_ignore", names("none"), "physical groups of the mesh that are left out on purpose");
    option(&Structure::allow_loose, "<structure>_allow_loose", flag(false), "pieces that nothing holds, and coincident nodes that nothing joins, are meant");
    option(&Structure::matrices, "<structure>_matrices", text("folder", "none", "a folder with dofs.csv, stiffness.mtx, mass.mtx, or none"), "its matrices, in place of its elements' own; the mesh says where faces and probes are");
    option("<structure>_model", word("full|modal|switched", "full"), "the finite elements themselves, a reduction to modes and attachment vectors, or modes while nothing strikes and the finite elements else");
    option.template part<ModalModel>();
    option(&Structure::numbers, "<structure>_numbers", word("double|single", "double"), "numbers that hexahedra of general shape keep for their products, in 64 or 32 bits: in 32 they are read in half of the time, and frequencies move by some 1e-8");
    option(&Structure::mass_scaling, "<structure>_mass_scaling", real("s", "0", not_negative), "stable time step for which elements that allow less (not tension-only bars), or fast generalised coordinates, get mass in proportion to their stiffness; 0: none");
    option.template part<StepTarget>();
    option(&Structure::initial_displacement, "<structure>_initial_displacement", reals("m", "0,0,0", "three numbers x,y,z"), "of every free node at t = 0");
    option(&Structure::initial_velocity, "<structure>_initial_velocity", reals("m/s", "0,0,0", "three numbers x,y,z"), "of every free node at t = 0");
    option(&Structure::initial_state, "<structure>_initial_state", text("file", "none", "a file or none"), "displacement and velocity of single nodes at t = 0, in place of those of all: a table with a first line of names, node or x,y,z, then some of ux to rz and vx to wz");
    option(&Structure::gravity, "<structure>_gravity", reals("m/s2", absent("left out: 0,0,-gravity"), "three numbers x,y,z"), "constant body acceleration; without preload it is applied at once at t = 0");
    option(&Structure::p_delta, "<structure>_p_delta", flag(false), "the axial forces of beams and bars at rest turn with them: weight and loads on columns that lean; needs preload static, and gravity or loads");
    option("<structure>_damping_alpha", real("1/s", "0", not_negative), "Rayleigh damping, mass term: C = alpha M + beta K");
    option("<structure>_damping_beta", real("s", "0", not_negative), "Rayleigh damping, stiffness term");
    option("<structure>_damping_ratio", real("-", absent("optional"), damping_ratio), "instead of alpha and beta: damping ratio at two frequencies");
    option("<structure>_damping_frequencies", reals("Hz", absent("required with the ratio"), "two numbers f1,f2", positive), "the two frequencies of the damping ratio");
    option("<structure>_damping_factor", real("-", "1", not_negative), "factor on the structure's damping, whichever way it is given: alpha and beta, uniform or modal ratios");
    option("<structure>_stiffness_factor", real("-", "1", positive), "factor on its stiffness: on Young's moduli and springs, or on the squared frequencies of a reduction");
    option.template part<UniformDamping>();
    option.template part<Soil>();
    // clang-format on
  }
};

}  // namespace pounding
