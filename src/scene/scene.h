#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/contact.h"
#include "scene/equipment.h"
#include "scene/load.h"
#include "scene/probe.h"
#include "scene/structure.h"
#include "scene/support.h"

/// Plain structs of the user's scene, in SI units, validated; made by scene/scene_reader and
/// constant afterwards. Identical on every rank.
namespace pounding {

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

struct SpectraRequest {
  std::vector<double> damping_ratios;  ///< [-]
  std::vector<double> frequencies;     ///< [Hz], increasing
  double start = 0;                    ///< of the samples that count for spectra and peaks [s]
  double peak_frequency = 0;           ///< of the low-pass before peaks of acceleration [Hz]

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option(&SpectraRequest::damping_ratios, "spectra_damping", reals("-", "0.05", "a comma-separated list of numbers", damping_ratio), "damping ratios of the oscillators", free_on_restart);
    option("spectra_frequencies", text("Hz", "0.5:400:200log", "start:stop:COUNTlog, start:stop:COUNTlin (COUNT 2 to 100000) or an increasing list", positive), "frequencies of the oscillators", free_on_restart);
    option(&SpectraRequest::start, "spectra_start", real("s", "0", not_negative), "time from which spectra and peak values count: the oscillators are at rest then", free_on_restart);
    option(&SpectraRequest::peak_frequency, "peak_frequency", real("Hz", "0", not_negative), "peaks of acceleration are those after a low-pass at this frequency; 0: the highest of spectra_frequencies", free_on_restart);
    // clang-format on
  }
};

/// A run for the sake of an accepted error that had a larger one.
struct TriedFidelity {
  int modes = 0;         ///< of every reduced structure; 0: full order with scaled mass
  double error = 0;      ///< estimated, rms of the logarithm of the floor spectra's ratio [-]
  double wall_time = 0;  ///< estimate included [s]
};

/// Places on the faces of contacts whose largest mean force is looked for.
struct StruckPlaces {
  std::vector<double> areas;  ///< squares [m2]
  std::vector<double> edges;  ///< lengths along the faces, as high as these [m]
  bool asked() const { return !areas.empty() || !edges.empty(); }

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option(&StruckPlaces::areas, "struck_areas", reals("m2", "0", "areas", not_negative), "squares, anywhere on the faces of contacts, over which the largest mean pressure of force_window is taken; 0: none");
    option(&StruckPlaces::edges, "struck_edges", reals("m", "0", "lengths", not_negative), "lengths along the faces of contacts, over which the largest force per length of force_window is taken, over the face's whole height; 0: none");
    // clang-format on
  }
};

/// How meshes are read.
struct MeshReading {
  double time_limit = 0;  ///< for Gmsh to make or read one of them [s]
  int splits = 0;         ///< of every element, see mesh/split_mesh.h

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option(&MeshReading::time_limit, "mesh_time_limit", real("s", "600", positive), "time that Gmsh may take for one mesh", free_everywhere);
    option(&MeshReading::splits, "mesh_splits", integer("-", "0", closed(0, 4)), "times that every element is split in the middle of its edges, into 8 of a solid, 4 of a shell, 2 of a beam; bars and springs stay whole");
    // clang-format on
  }
};

/// How the program came to the fidelity of a run by an accepted error.
struct FidelityClimb {
  double target = 0;                 ///< that error, rms as above [-]; 0: none
  int modes = 0;                     ///< of the structures in this run; 0: full order
  bool scaled = false;               ///< with scaled mass
  std::vector<TriedFidelity> tried;  ///< before it
  std::string reason;                ///< why it is at full order; empty where it is not
};

/// How errors of a run are estimated.
struct Certificate {
  double window = 0;  ///< at full order, by which that is done [s]; 0: it is not
  bool mesh = false;  ///< the error of the mesh as well, see fidelity/mesh_error.h

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option(&Certificate::window, "fidelity_window", real("s", "0", not_negative), "part of the run around its strongest impact that is stepped at full order as well, by which the error of reduced structures is estimated; 0: none", free_of_fidelity);
    option(&Certificate::mesh, "fidelity_mesh", flag(false), "with fidelity_window: that part is stepped on the mesh split once as well, and a whole reduced run made there, by which the error of the mesh is estimated", free_of_fidelity);
    // clang-format on
  }
};

struct KeptInputs;  // mesh/kept_inputs.h

struct Scene {
  std::string title;
  /// Inputs that models of this scene, built one after the other, share; null: each reads its own.
  std::shared_ptr<KeptInputs> kept;
  Certificate certificate;
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
  std::string motion_incoherent;   ///< file of the part in which it parts; empty: it moves alike
  Resampling resampling = Resampling::linear;
  StiffnessMethod stiffness = StiffnessMethod::automatic;
  PartitionBy partition_by = PartitionBy::automatic;
  std::string mesh_pieces;    ///< folder of meshes cut before; empty: none
  int write_mesh_pieces = 0;  ///< number of ranks to cut them for; 0: they are read
  std::vector<Probe> probes;
  std::vector<Span> spans;
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
  bool preload = false;         ///< start from the static equilibrium
  bool keeps_matrices = false;  ///< after it, for members of an ensemble
  SolverChoice preload_solver = SolverChoice::automatic;
  double gap_tolerance = 0;      ///< contact where gap <= gap_tolerance x model size [-]
  double impact_merge_time = 0;  ///< contacts separated by less are one episode [s]
  double force_window = 0;       ///< over which the largest force of an impact is taken [s]
  StruckPlaces struck;
  int csv_digits = 0;          ///< significant digits of the numbers in the tables of the results
  double output_interval = 0;  ///< of the probes [s]
  double gap_interval = 0;     ///< of the gaps at least; 0: with every sample of the probes [s]
  int energy_interval = 0;     ///< steps between two lines of the energy ledger
  MeshReading meshes;
  bool dry_run = false;
  std::string vector_unit;         ///< whose kernels compute (use_vector_unit)
  double checkpoint_interval = 0;  ///< wall time between checkpoints [s]; 0: none
  int checkpoint_steps = 0;        ///< steps between checkpoints; 0: none
  std::string export_matrices;     ///< folder for the matrices of the scene; empty: none
  std::string restart;             ///< checkpoint to continue from; empty: a new run
  /// Amplitudes over the first corner of each law, whose loops are written in place of a run [-].
  std::vector<double> law_cycles;
  std::string output;  ///< result folder

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option(&Scene::title, "title", text("text", "", "text"), "one line that names the run", free_but_in_scene);
    option("structures", names(required), "the buildings");
    option("contacts", names("none"), "the places where they may hit");
    option("probes", names("none"), "where the motion is recorded");
    option("spans", names("none"), "what goes from one structure to another: motions of its two ends and against each other, rotations too");
    option("loops", names("none"), "links whose force is recorded over their elongation: structure:group of links that yield or damp or of beams that yield, or a contact with a filler or faces that are crushed");
    option("loops_at", text("m", absent("left out: all of them"), "points x,y,z; x,y,z"), "of each group in loops, the element nearest to each point only");
    option("forces", names("none"), "forces that are recorded: reactions, storeys, members, shells, cuts");
    option("supports", names("none"), "parts of the ground that move otherwise than the motion says");
    option("loads", names("none"), "forces on groups of structures beside gravity and the motion of the ground");
    option("pools", names("none"), "water in tanks of the structures"); option("equipment", names("none"), "items of equipment whose capacity is set beside the spectra of their floors");
    option(&Scene::end_time, "end_time", real("s", required, positive), "duration of the run", free_of_steps);
    option(&Scene::courant, "courant", real("-", "0.9", fraction), "fraction of the stable time step that is used", free_of_steps);
    option(&Scene::time_step, "time_step", real("s", "0", not_negative), "time step; 0: courant x the stable one, or a shorter one that resolves vibrations up to the last of spectra_frequencies", free_of_steps);
    option(&Scene::allow_unstable, "allow_unstable", flag(false), "accept a time step above the stable one (for studies)", free_of_steps);
    option(&Scene::omega_max_tolerance, "omega_max_tolerance", real("-", "1e-3", closed(1e-10, 0.1)), "part by which omega_max may be too large, and the stable step too small, where 1e-10 would take long", free_of_steps);
    option(&Scene::modes, "modes", integer("-", "12", not_negative), "lowest modes computed per structure", free_but_in_scene);
    option(&Scene::modes_solver, "modes_solver", word("auto|direct|iterative", "auto"), "how they are found at full order: with a factorisation, by an iteration with multigrid, or by that where the factor would take too much memory", free_but_in_scene);
    option(&Scene::write_modes, "write_modes", flag(false), "write their shapes to modes.h5, and modes.xdmf for ParaView", free_everywhere);
    option(&Scene::write_model, "write_model", flag(false), "write the meshes with groups, supports, contacts and probes to model.xdmf and model.h5 for ParaView", free_everywhere);
    option("gravity", real("m/s2", "0", not_negative), "acceleration of gravity, along -z, of every structure without one of its own");
    option(&Scene::preload, "preload", word("none|static", "none"), "static: the run starts from the equilibrium under gravity, contacts closed where they carry");
    option(&Scene::preload_solver, "preload_solver", word("auto|direct|iterative", "auto"), "how the equilibrium is solved: by a factorisation, by conjugate gradients, or as the memory allows", free_in_pieces);
    option(&Scene::gap_tolerance, "gap_tolerance", real("-", "1e-12", not_negative), "contact where gap <= gap_tolerance x model size", free_in_pieces);
    option(&Scene::impact_merge_time, "impact_merge_time", real("s", "1e-3", not_negative), "contacts separated by less are one impact", free_in_pieces);
    option(&Scene::force_window, "force_window", real("s", "1e-3", positive), "time over which the largest force of an impact is taken: its largest impulse within it, over it", free_in_pieces);
    option(&Scene::output_interval, "output_interval", real("s", "5e-5", positive), "time between two samples of the probes", free_in_pieces);
    option(&Scene::gap_interval, "gap_interval", real("s", "0", not_negative), "time between two samples of the gaps, not a number in between unless they were looked at anyway; 0: with every sample of the probes", free_in_pieces);
    option(&Scene::energy_interval, "energy_interval", integer("steps", "100", at_least_1), "steps between two lines of the energy balance; each takes one more product with the stiffness", free_in_pieces);
    option.part(&Scene::meshes);
    option(&Scene::law_cycles, "law_cycles", reals("-", "0", "amplitudes over the first corner", not_negative), "in place of a run: takes every law of the scene through cycles of these amplitudes and writes laws.csv; 0: none");
    option(&Scene::dry_run, "dry_run", flag(false), "check the model, print the cost of a run, and stop", free_everywhere);
    option(&Scene::vector_unit, "vector_unit", word("auto|v2|v3|v4", "auto"), "whose kernels compute: v2 (SSE4.2), v3 (AVX2 and FMA), v4 (AVX-512), or the best that every rank has", free_everywhere);
    option(&Scene::progress_interval, "progress_interval", real("s", "2", positive), "phases of the start-up that take longer say how far they are, twice as late each time; in a log the steps as well", free_everywhere);
    option(&Scene::output, "output", text("folder", "results", "a folder"), "result folder", free_everywhere);
    option(&Scene::csv_digits, "csv_digits", integer("-", "9", digit_count), "significant digits of the numbers in spectra.csv, impacts.csv, energy.csv and forces.csv; 17: to the bit", free_everywhere);
    option(&Scene::fields_interval, "fields_interval", real("s", "0", not_negative), "time between two frames of the motion of all nodes in fields.h5, for ParaView; 0: none", free_but_on_restart);
    option(&Scene::fields_start, "fields_start", real("s", "0", not_negative), "time of the first frame", free_but_on_restart);
    option(&Scene::fields_end, "fields_end", real("s", "0", not_negative), "no frame is later; 0: until the end of the run", free_but_on_restart);
    option(&Scene::fields_format, "fields_format", word("xdmf|vtkhdf|both", "both"), "how ParaView finds the frames in fields.h5: by fields.xdmf, by fields.vtkhdf (ParaView 5.12 and later), or by either", free_everywhere);
    option(&Scene::checkpoint_interval, "checkpoint_interval", real("s", "0", not_negative), "wall time between two checkpoints; 0: one only when a signal stops the run", free_everywhere);
    option(&Scene::checkpoint_steps, "checkpoint_steps", integer("steps", "0", not_negative), "steps between two checkpoints; 0: none", free_everywhere);
    option("ensemble", text("file", "none", "a CSV file or none"), "many runs at once: a table whose first line names options of the scene, with a line of values for each run; writes ensemble.h5 and ensemble.csv", free_in_ensemble);
    option(&Scene::export_matrices, "export_matrices", text("folder", "none", "a folder or none"), "writes the matrices of every structure there, with contact, influence and probe rows", free_but_in_pieces);
    option(&Scene::restart, "restart", text("file", "none", "a checkpoint.h5 or none"), "checkpoint to continue from, with the history.h5 beside it", free_everywhere);
    option(&Scene::partition_by, "partition", word("auto|elements|structures", "auto"), "parts shared out among the ranks: elements, whole structures, or whichever costs a step less", free_but_in_pieces);
    option(&Scene::mesh_pieces, "mesh_pieces", text("folder", "none", "a folder or none"), "meshes cut before, of which every rank reads its piece alone", free_everywhere);
    option(&Scene::write_mesh_pieces, "write_mesh_pieces", integer("ranks", "0", closed(0, 99999)), "cuts the meshes for so many ranks into the folder mesh_pieces, and stops; 0: does not", free_everywhere);
    option(&Scene::stiffness, "stiffness", word("auto|assembled|element", "auto"), "how K is applied: as a matrix, element by element, or as suits the mesh", free_in_pieces);
    option("fidelity_target", real("-", absent("optional"), fraction), "rms error of the floor spectra beside full order that is accepted (0.05: 5 %); the program takes as few modes as it finds to be enough, or full order", free_of_fidelity);
    option.part(&Scene::certificate);
    option(&Scene::motion_from_below, "motion_input", word("base|below", "base"), "place of the motion: the ground under every support, or a wave that enters from below through the faces of absorbing_base");
    option(&Scene::motion_incoherent, "motion_incoherent", text("file", "none", "a file or none"), "wave from below that does not move all nodes of its faces alike: shapes and histories beside the motion, as run/incoherent makes them");
    option("motion_level", real("-", "1", positive), "factor on the motion along all axes, after its pga or scale", free_in_pieces);
    option(&Scene::resampling, "resampling", word("linear|band_limited", "linear"), "how records are upsampled to the time step", free_in_pieces);
    // clang-format on
  }
};

/// Number of a structure by its name, which is that of one of them.
inline std::size_t structure_number(const Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.structures, name, &Structure::name);
  return static_cast<std::size_t>(found - scene.structures.begin());
}

}  // namespace pounding
