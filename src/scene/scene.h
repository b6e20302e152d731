#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/types.h"
#include "elements/element_traits.h"
#include "scene/equipment.h"
#include "scene/filler.h"
#include "scene/hysteresis.h"
#include "scene/load.h"
#include "scene/soil.h"
#include "scene/uniform_damping.h"

/// Plain structs of the user's scene, in SI units, validated; made by scene/scene_reader and
/// constant afterwards. Identical on every rank.
namespace pounding {

struct Material {
  std::string name;
  double young = 0;    ///< Young's modulus [Pa]
  double poisson = 0;  ///< Poisson's ratio [-]
  double density = 0;  ///< [kg/m3]
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
  double area = 0;                   ///< bars [m2]
  double thickness = 0;              ///< shells [m]
  double rotary_inertia_factor = 0;  ///< shells [-], see elements/flat_shell.h
  double drilling_factor = 1;        ///< of the drilling stiffness of shells [-]
  double added_mass = 0;             ///< shells [kg/m2], beams and bars [kg/m]
  double mass = 0;                   ///< point masses, at each node of the group [kg]
  Vector3 rotary_inertia{0, 0, 0};   ///< point masses [kg m2]
  /// Grounded springs: `stiffness` and `dashpot` are per length or area then.
  Spread spread = Spread::none;
  std::array<double, 6> stiffness{};  ///< springs: along and about x, y, z [N/m, N m]
  std::array<double, 6> dashpot{};    ///< springs [N s/m, N m s]
  bool compression_only = false;      ///< grounded springs: along z they push up only
  NonlinearSpring nonlinear;          ///< springs and bars
  YieldingSection yielding;           ///< beams
  YieldingShell yielding_shell;       ///< shells
  /// An element law adds to the forces K u of its elements; see InelasticElements. Not in reduced
  /// structures, see yields_by_links.
  bool inelastic = false;
  std::optional<Rayleigh> damping;  ///< in place of the structure's
  /// Displacement [m] and velocity [m/s] of its nodes at t = 0, in place of the structure's.
  std::optional<Vector3> initial_displacement;
  std::optional<Vector3> initial_velocity;
  std::optional<Foundation> foundation;  ///< soil: empty until the mesh is read, see lay_foundation
};

/// Elements whose force in one direction is none: tension-only bars, compression-only springs.
inline bool is_one_way(const Region& region) {
  return region.element == ElementType::tension_bar || region.compression_only;
}

/// Beams that bend by shear as well.
inline bool is_flexible_in_shear(const Region& region) {
  return region.element == ElementType::beam && region.section->shear_area_y > 0;
}

/// Elements whose stiffness, or some of it, is no part of K: one-way ones, springs and bars that
/// yield.
inline bool follows_law(const Region& region) {
  return is_one_way(region) || region.nonlinear.yields();
}

/// Elements whose force is not K u, whether or not K holds their first slope.
inline bool is_nonlinear(const Region& region) {
  return follows_law(region) || region.nonlinear.option() != nullptr || region.yielding.any() ||
         region.yielding_shell.any();
}

/// Beams of a reduced structure whose sections yield: its modes hold them as elastic, and links the
/// difference.
inline bool yields_by_links(const Region& region) {
  return region.yielding.any() && !region.inelastic;
}

/// The option that makes a region nonlinear.
inline const char* law_option(const Region& region) {
  if (region.yielding.any()) return region.yielding.option();
  if (region.yielding_shell.any()) return region.yielding_shell.option();
  if (region.compression_only) return "<structure>_<group>_compression_only";
  const char* const option = region.nonlinear.option();
  return option != nullptr ? option : "<structure>_<group>_tension_only";
}

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
  std::string other;     ///< of a join or tie: where the nearest node or facet is looked for
  bool implied = false;  ///< a mat on soil: nobody asked, and it may be part of a larger body

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

/// Faces of solids through which waves leave a structure, see mesh/global_mesh.h.
struct AbsorbingFace {
  std::string group;
  bool is_base = false;  ///< the motion from below enters through it
};

struct Structure {
  std::string name;
  std::string matrices;  ///< folder, see system/matrix_system.h; empty: of its elements
  std::string mesh;      ///< .geo or .msh
  std::vector<std::pair<std::string, std::string>> mesh_set;  ///< parameters of a .geo
  std::vector<std::string> ignored_groups;                    ///< of the mesh, left out on purpose
  bool allow_loose = false;  ///< pieces and coincident nodes that nothing joins
  std::vector<Clamp> clamps;
  std::vector<RigidGroup> rigid_groups;
  std::vector<AbsorbingFace> absorbing;
  std::vector<Region> regions;
  Rayleigh damping;
  std::optional<UniformDamping> uniform_damping;  ///< in place of Rayleigh damping, which is 0 then
  std::optional<ModalModel> modal;                ///< nothing: the finite-element model itself
  std::optional<Soil> soil;               ///< under its mat; one of the regions is its element
  bool p_delta = false;                   ///< weight at rest turns with the columns
  double mass_scaling = 0;                ///< step [s] for which stiff elements get mass; 0: none
  std::optional<StepTarget> step_target;  ///< its step is `mass_scaling` until one is designed
  Vector3 initial_displacement{0, 0, 0};  ///< of every free node [m]
  Vector3 initial_velocity{0, 0, 0};      ///< of every free node [m/s]
  std::string initial_state;              ///< file of those of single nodes; empty: none
  Vector3 gravity{0, 0, 0};               ///< constant body acceleration [m/s2]

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
  Rayleigh damping_of(const Region& region) const { return region.damping.value_or(damping); }
};

/// One side of a contact: a physical group (surface or shell edge) of a structure, or a rigid wall
/// that follows the ground (structure "wall", primary side only). Of a stop the nodes of a group,
/// or the one nearest to a point "x,y,z".
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
};

/// Makes a contact a stop between nodes of its sides.
struct Stop {
  /// Unit vector along which the primary lies beyond the secondary; nothing: the line between them.
  std::optional<Vector3> along;
  double stiffness = 0;  ///< beyond the gap, of each pair of nodes [N/m]; 0: it is hard
  double dashpot = 0;    ///< beside that, while it presses [N s/m]
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
};

/// A recorded accelerogram in a file.
struct RecordedMotion {
  std::string file;
  std::string unit;  ///< "", "g", "m/s2", "cm/s2" or "mm/s2"; "": the file's own header says it
  double time_step =
      0;           ///< [s]; needed for files without a time column or header; 0: from the file
  int column = 0;  ///< of the acceleration, or component of the file, 1-based; 0: the only one
};

/// A synthetic accelerogram matched to a 5 % target spectrum.
struct SyntheticMotion {
  std::string target;  ///< CSV of frequency [Hz], pseudo-acceleration / PGA [-]
  int seed = 1;
  double duration = 25;                   ///< [s]
  std::array<double, 2> envelope{2, 15};  ///< end of the rise, start of the decay [s]
};

/// Ground motion in one direction: scaled to a peak ground acceleration, or by a factor.
struct MotionComponent {
  std::variant<RecordedMotion, SyntheticMotion> source;
  double pga = 0;    ///< [m/s2]; 0: as recorded times `scale`
  double scale = 1;  ///< [-]
};

/// A physical group of a structure whose clamped nodes are on a support, or all ground of the
/// structure.
struct SupportedGroup {
  std::string structure;
  std::string group;  ///< empty: all clamped nodes, and the ground of springs, dashpots and soil

  bool is_all_ground() const { return group.empty(); }
};

/// Soil around a rigid foundation that lies below the surface.
struct Embedment {
  double depth = 0;       ///< of its underside [m]
  double velocity = 0;    ///< of shear waves in the soil around it [m/s]
  double half_width = 0;  ///< half a side of it, or its radius [m]

  double travel() const { return depth / velocity; }  ///< of a wave from it to the surface [s]
};

/// A part of the ground that moves on its own, as one rigid body, with all that is clamped to it;
/// or all the ground of a structure, springs included.
struct Support {
  std::string name;
  std::vector<SupportedGroup> groups;
  double delay = 0;         ///< with which the scene's motion arrives [s]
  Vector3 factor{1, 1, 1};  ///< on that motion; 0: it is at rest
  /// Motion of its own along x, y, z, in place of that; rotations about them [rad/s2].
  std::array<std::optional<MotionComponent>, 6> motion;
  Vector3 point{0, 0, 0};  ///< about which it turns [m]
  /// It moves as a massless embedded foundation does in the waves that move the surface.
  std::optional<Embedment> embedment;
};

/// One component of the motion of a support beside that of the scene's ground: displacement along
/// an axis (0-2) or rotation (3-5).
struct SupportColumn {
  int support = 0;
  int component = 0;
  Vector3 point{0, 0, 0};  ///< about which it turns [m]
};

/// How the stiffness is applied: as a sparse matrix, element by element without one, or as suits
/// the mesh (element by element where enough elements have a kernel of their own).
enum class StiffnessMethod { automatic, assembled, element };

/// Things shared out among the ranks: the elements of all structures, structures as a whole, or
/// whichever costs a step less.
enum class PartitionBy { automatic, elements, structures };

/// How equations with the stiffness matrix are solved: by a factorisation, by an iteration, or by
/// the factorisation where it fits into the memory.
enum class SolverChoice { automatic, direct, iterative };

/// Files that list the frames of the motion of all nodes for ParaView.
enum class FieldsFormat { xdmf, vtkhdf, both };

enum class Resampling { linear, band_limited };

struct Probe {
  std::string name;
  std::string structure;
  std::vector<Vector3> points;  ///< each snaps to the nearest node [m]
  std::string group;            ///< or all nodes of a physical group
  bool average = true;          ///< one averaged channel set, or one per node
  bool floor = false;           ///< the level of a floor, between which drifts are
};

/// Links whose force is recorded over their elongation: those of a region, or the filler of a
/// contact.
struct Loop {
  std::string name;             ///< structure:group, or that of the contact
  std::string structure;        ///< of the region
  std::string group;            ///< of the region
  std::string contact;          ///< or the contact
  std::vector<Vector3> points;  ///< the element nearest to each; empty: all of them [m]
};

struct SpectraRequest {
  std::vector<double> damping_ratios;  ///< [-]
  std::vector<double> frequencies;     ///< [Hz], increasing
  double start = 0;                    ///< of the samples that count for spectra and peaks [s]
  double peak_frequency = 0;           ///< of the low-pass before peaks of acceleration [Hz]
};

/// A reduction that was run for the sake of an accepted error, and had a larger one.
struct TriedFidelity {
  int modes = 0;         ///< of every reduced structure
  double error = 0;      ///< estimated, rms of the logarithm of the floor spectra's ratio [-]
  double wall_time = 0;  ///< estimate included [s]
};

/// How the program came to the fidelity of a run by an accepted error.
struct FidelityClimb {
  double target = 0;                 ///< that error, rms as above [-]; 0: none
  int modes = 0;                     ///< of the structures in this run; 0: full order
  std::vector<TriedFidelity> tried;  ///< before it
  std::string reason;                ///< why it is at full order; empty where it is not
};

struct Scene {
  std::string title;
  double fidelity_window = 0;  ///< at full order, by which errors are estimated [s]; 0: none
  FidelityClimb fidelity;
  /// Options that cut meshes depend on, see scene/resolved_options.h.
  std::vector<std::pair<std::string, std::string>> mesh_options;
  std::vector<std::string> warnings;  ///< one line each: options that may not be meant
  std::vector<Structure> structures;
  std::vector<Contact> contacts;
  std::array<std::optional<MotionComponent>, 3> motion;
  std::vector<Support> supports;   ///< that move otherwise than `motion`
  std::vector<Load> loads;         ///< forces beside gravity and the ground's
  bool motion_from_below = false;  ///< an incident wave; else the ground itself moves like that
  Resampling resampling = Resampling::linear;
  StiffnessMethod stiffness = StiffnessMethod::automatic;
  PartitionBy partition_by = PartitionBy::automatic;
  std::string mesh_pieces;    ///< folder of meshes cut before; empty: none
  int write_mesh_pieces = 0;  ///< number of ranks to cut them for; 0: they are read
  std::vector<Probe> probes;
  std::vector<Loop> loops;
  std::vector<ForceItem> forces;
  SpectraRequest spectra;
  std::vector<Equipment> equipment;
  double end_time = 0;             ///< [s]
  double courant = 0;              ///< fraction of the stable time step [-]
  double time_step = 0;            ///< [s]; 0: courant times the stable one
  bool allow_unstable = false;     ///< accept a time step above the stable one (for studies)
  double omega_max_tolerance = 0;  ///< accepted where omega_max to 1e-10 takes long [-]
  double progress_interval = 0;    ///< of the lines that a long phase of the start-up prints [s]
  int modes = 0;                   ///< lowest modes to compute per structure
  SolverChoice modes_solver = SolverChoice::automatic;
  bool write_modes = false;    ///< their shapes as well
  bool write_model = false;    ///< the meshes with their groups, materials and sections
  double fields_interval = 0;  ///< between two pictures of the whole motion [s]; 0: none
  double fields_start = 0;     ///< of the first [s]
  double fields_end = 0;       ///< of the last at most [s]; 0: the end of the run
  FieldsFormat fields_format = FieldsFormat::both;
  bool preload = false;  ///< start from the static equilibrium
  SolverChoice preload_solver = SolverChoice::automatic;
  double gap_tolerance = 0;      ///< contact where gap <= gap_tolerance x model size [-]
  double impact_merge_time = 0;  ///< contacts separated by less are one episode [s]
  double force_window = 0;       ///< over which the largest force of an impact is taken [s]
  int csv_digits = 0;            ///< significant digits of the numbers in the tables of the results
  double output_interval = 0;    ///< of the probes [s]
  double gap_interval = 0;       ///< of the gaps at least; 0: with every sample of the probes [s]
  int energy_interval = 0;       ///< steps between two lines of the energy ledger
  double mesh_time_limit = 0;    ///< for Gmsh to make or read one mesh [s]
  bool dry_run = false;
  std::string vector_unit;         ///< whose kernels compute (use_vector_unit)
  double checkpoint_interval = 0;  ///< wall time between checkpoints [s]; 0: none
  int checkpoint_steps = 0;        ///< steps between checkpoints; 0: none
  std::string export_matrices;     ///< folder for the matrices of the scene; empty: none
  std::string restart;             ///< checkpoint to continue from; empty: a new run
  /// Amplitudes over the first corner of each law, whose loops are written in place of a run [-].
  std::vector<double> law_cycles;
  std::string output;  ///< result folder
};

}  // namespace pounding
