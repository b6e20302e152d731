#include "scene/option_table.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "scene/hysteresis.h"

namespace pounding {
namespace {

using namespace option_words;

constexpr Range fraction{0, 1, true, false};
constexpr Range uniform_ratio{0, 0.3, false, false};
constexpr Range eigen_tolerance{1e-10, 0.1, false, false};
constexpr Range rank_count{0, 99999, false, false};
constexpr Range filter_count{1, 8, false, false};
constexpr Range dashpot_power{0.01, 2, false, false};
constexpr Range below_1{0, 1, false, true};
constexpr Range up_to_1{0, 1, false, false};
constexpr Range poisson_ratio{-1, 0.5, true, true};
constexpr Range soil_poisson{0, 0.5, false, true};

using Family = ElementFamily;
constexpr Families for_shells{Family::shell};
constexpr Families for_beams{Family::beam};
constexpr Families for_bars{Family::bar};
constexpr Families for_points{Family::point_mass};
constexpr Families for_grounded{Family::grounded_spring};
constexpr Families for_springs{Family::grounded_spring, Family::spring};
constexpr Families for_beams_and_bars{Family::beam, Family::bar};
constexpr Families for_beams_and_shells{Family::beam, Family::shell};
constexpr Families for_bars_and_springs{Family::bar, Family::grounded_spring, Family::spring};
constexpr Families for_extents{Family::solid, Family::shell, Family::beam, Family::bar};
constexpr Families for_yielding{Family::shell, Family::beam, Family::bar, Family::grounded_spring,
                                Family::spring};

using enum Comparison;
constexpr Comparisons free_everywhere{pieces, scene, ensemble, restart};
constexpr Comparisons free_but_in_pieces{scene, ensemble, restart};
constexpr Comparisons free_but_in_scene{pieces, ensemble, restart};
constexpr Comparisons free_but_on_restart{pieces, scene, ensemble};
constexpr Comparisons free_of_steps{pieces, restart};
constexpr Comparisons free_of_fidelity{pieces, ensemble};
constexpr Comparisons free_in_pieces{pieces};
constexpr Comparisons free_in_ensemble{ensemble};
constexpr Comparisons free_on_restart{restart};

constexpr Preset required{false, true, "required"};

// clang-format off
constexpr std::array option_rows{
    OptionRow{Block::run, "title", Kind::text, "text", value(""), any, "text", "one line that names the run", {}, free_but_in_scene},
    OptionRow{Block::run, "structures", Kind::names, "names", required, any, "", "the buildings"},
    OptionRow{Block::run, "contacts", Kind::names, "names", value("none"), any, "", "the places where they may hit"},
    OptionRow{Block::run, "probes", Kind::names, "names", value("none"), any, "", "where the motion is recorded"},
    OptionRow{Block::run, "loops", Kind::names, "names", value("none"), any, "", "links whose force is recorded over their elongation: structure:group of links that yield or damp or of beams that yield, or a contact with a filler or faces that are crushed"},
    OptionRow{Block::run, "loops_at", Kind::text, "m", absent("left out: all of them"), any, "points x,y,z; x,y,z", "of each group in loops, the element nearest to each point only"},
    OptionRow{Block::run, "forces", Kind::names, "names", value("none"), any, "", "forces that are recorded: reactions, storeys, members, shells, cuts"},
    OptionRow{Block::run, "supports", Kind::names, "names", value("none"), any, "", "parts of the ground that move otherwise than the motion says"},
    OptionRow{Block::run, "loads", Kind::names, "names", value("none"), any, "", "forces on groups of structures beside gravity and the motion of the ground"},
    OptionRow{Block::run, "equipment", Kind::names, "names", value("none"), any, "", "items of equipment whose capacity is set beside the spectra of their floors"},
    OptionRow{Block::run, "end_time", Kind::real, "s", required, positive, "", "duration of the run", {}, free_of_steps},
    OptionRow{Block::run, "courant", Kind::real, "-", value("0.9"), fraction, "", "fraction of the stable time step that is used", {}, free_of_steps},
    OptionRow{Block::run, "time_step", Kind::real, "s", value("0"), not_negative, "", "time step; 0: courant x the stable one, or a shorter one that resolves vibrations up to the last of spectra_frequencies", {}, free_of_steps},
    OptionRow{Block::run, "allow_unstable", Kind::boolean, "flag", value("false"), any, "", "accept a time step above the stable one (for studies)", {}, free_of_steps},
    OptionRow{Block::run, "omega_max_tolerance", Kind::real, "-", value("1e-3"), eigen_tolerance, "", "part by which omega_max may be too large, and the stable step too small, where 1e-10 would take long", {}, free_of_steps},
    OptionRow{Block::run, "modes", Kind::integer, "-", value("12"), not_negative, "", "lowest modes computed per structure", {}, free_but_in_scene},
    OptionRow{Block::run, "modes_solver", Kind::choice, "word", value("auto"), any, "auto|direct|iterative", "how they are found at full order: with a factorisation, by an iteration with multigrid, or by that where the factor would take too much memory", {}, free_but_in_scene},
    OptionRow{Block::run, "write_modes", Kind::boolean, "flag", value("false"), any, "", "write their shapes to modes.h5, and modes.xdmf for ParaView", {}, free_everywhere},
    OptionRow{Block::run, "write_model", Kind::boolean, "flag", value("false"), any, "", "write the meshes with groups, supports, contacts and probes to model.xdmf and model.h5 for ParaView", {}, free_everywhere},
    OptionRow{Block::run, "gravity", Kind::real, "m/s2", value("0"), not_negative, "", "acceleration of gravity, along -z, of every structure without one of its own"},
    OptionRow{Block::run, "preload", Kind::choice, "word", value("none"), any, "none|static", "static: the run starts from the equilibrium under gravity, contacts closed where they carry"},
    OptionRow{Block::run, "preload_solver", Kind::choice, "word", value("auto"), any, "auto|direct|iterative", "how the equilibrium is solved: by a factorisation, by conjugate gradients, or as the memory allows", {}, free_in_pieces},
    OptionRow{Block::run, "gap_tolerance", Kind::real, "-", value("1e-12"), not_negative, "", "contact where gap <= gap_tolerance x model size", {}, free_in_pieces},
    OptionRow{Block::run, "impact_merge_time", Kind::real, "s", value("1e-3"), not_negative, "", "contacts separated by less are one impact", {}, free_in_pieces},
    OptionRow{Block::run, "force_window", Kind::real, "s", value("1e-3"), positive, "", "time over which the largest force of an impact is taken: its largest impulse within it, over it", {}, free_in_pieces},
    OptionRow{Block::run, "output_interval", Kind::real, "s", value("5e-5"), positive, "", "time between two samples of the probes", {}, free_in_pieces},
    OptionRow{Block::run, "gap_interval", Kind::real, "s", value("0"), not_negative, "", "time between two samples of the gaps, not a number in between unless they were looked at anyway; 0: with every sample of the probes", {}, free_in_pieces},
    OptionRow{Block::run, "energy_interval", Kind::integer, "steps", value("100"), at_least_1, "", "steps between two lines of the energy balance; each takes one more product with the stiffness", {}, free_in_pieces},
    OptionRow{Block::run, "mesh_time_limit", Kind::real, "s", value("600"), positive, "", "time that Gmsh may take for one mesh", {}, free_everywhere},
    OptionRow{Block::run, "law_cycles", Kind::reals, "-", value("0"), not_negative, "amplitudes over the first corner", "in place of a run: takes every law of the scene through cycles of these amplitudes and writes laws.csv; 0: none"},
    OptionRow{Block::run, "dry_run", Kind::boolean, "flag", value("false"), any, "", "check the model, print the cost of a run, and stop", {}, free_everywhere},
    OptionRow{Block::run, "vector_unit", Kind::choice, "word", value("auto"), any, "auto|v2|v3|v4", "whose kernels compute: v2 (SSE4.2), v3 (AVX2 and FMA), v4 (AVX-512), or the best that every rank has", {}, free_everywhere},
    OptionRow{Block::run, "progress_interval", Kind::real, "s", value("2"), positive, "", "phases of the start-up that take longer say how far they are, twice as late each time; in a log the steps as well", {}, free_everywhere},
    OptionRow{Block::run, "output", Kind::text, "folder", value("results"), any, "a folder", "result folder", {}, free_everywhere},
    OptionRow{Block::run, "csv_digits", Kind::integer, "-", value("9"), csv_digits, "", "significant digits of the numbers in spectra.csv, impacts.csv, energy.csv and forces.csv; 17: to the bit", {}, free_everywhere},
    OptionRow{Block::run, "fields_interval", Kind::real, "s", value("0"), not_negative, "", "time between two frames of the motion of all nodes in fields.h5, for ParaView; 0: none", {}, free_but_on_restart},
    OptionRow{Block::run, "fields_start", Kind::real, "s", value("0"), not_negative, "", "time of the first frame", {}, free_but_on_restart},
    OptionRow{Block::run, "fields_end", Kind::real, "s", value("0"), not_negative, "", "no frame is later; 0: until the end of the run", {}, free_but_on_restart},
    OptionRow{Block::run, "fields_format", Kind::choice, "word", value("both"), any, "xdmf|vtkhdf|both", "how ParaView finds the frames in fields.h5: by fields.xdmf, by fields.vtkhdf (ParaView 5.12 and later), or by either", {}, free_everywhere},
    OptionRow{Block::run, "checkpoint_interval", Kind::real, "s", value("0"), not_negative, "", "wall time between two checkpoints; 0: one only when a signal stops the run", {}, free_everywhere},
    OptionRow{Block::run, "checkpoint_steps", Kind::integer, "steps", value("0"), not_negative, "", "steps between two checkpoints; 0: none", {}, free_everywhere},
    OptionRow{Block::run, "ensemble", Kind::text, "file", value("none"), any, "a CSV file or none", "many runs at once: a table whose first line names options of the scene, with a line of values for each run; writes ensemble.h5 and ensemble.csv", {}, free_in_ensemble},
    OptionRow{Block::run, "export_matrices", Kind::text, "folder", value("none"), any, "a folder or none", "writes the matrices of every structure there, with contact, influence and probe rows", {}, free_but_in_pieces},
    OptionRow{Block::run, "restart", Kind::text, "file", value("none"), any, "a checkpoint.h5 or none", "checkpoint to continue from, with the history.h5 beside it", {}, free_everywhere},
    OptionRow{Block::run, "partition", Kind::choice, "word", value("auto"), any, "auto|elements|structures", "parts shared out among the ranks: elements, whole structures, or whichever costs a step less", {}, free_but_in_pieces},
    OptionRow{Block::run, "mesh_pieces", Kind::text, "folder", value("none"), any, "a folder or none", "meshes cut before, of which every rank reads its piece alone", {}, free_everywhere},
    OptionRow{Block::run, "write_mesh_pieces", Kind::integer, "ranks", value("0"), rank_count, "", "cuts the meshes for so many ranks into the folder mesh_pieces, and stops; 0: does not", {}, free_everywhere},
    OptionRow{Block::run, "stiffness", Kind::choice, "word", value("auto"), any, "auto|assembled|element", "how K is applied: as a matrix, element by element, or as suits the mesh", {}, free_in_pieces},
    OptionRow{Block::run, "fidelity_target", Kind::real, "-", absent("optional"), fraction, "", "rms error of the floor spectra beside full order that is accepted (0.05: 5 %); the program takes as few modes as it finds to be enough, or full order", {}, free_of_fidelity},
    OptionRow{Block::run, "fidelity_window", Kind::real, "s", value("0"), not_negative, "", "part of the run around its strongest impact that is stepped at full order as well, by which the error of reduced structures is estimated; 0: none", {}, free_of_fidelity},
    OptionRow{Block::run, "motion_input", Kind::choice, "word", value("base"), any, "base|below", "place of the motion: the ground under every support, or a wave that enters from below through the faces of absorbing_base"},
    OptionRow{Block::run, "motion_level", Kind::real, "-", value("1"), positive, "", "factor on the motion along all axes, after its pga or scale", {}, free_in_pieces},
    OptionRow{Block::run, "resampling", Kind::choice, "word", value("linear"), any, "linear|band_limited", "how records are upsampled to the time step", {}, free_in_pieces},

    OptionRow{Block::structure, "<structure>_mesh", Kind::text, "file", required, any, "a .geo or .msh file", "geometry to mesh (.geo) or mesh"},
    OptionRow{Block::structure, "<structure>_mesh_set", Kind::text, "pairs", value("none"), any, "name=value,name=value or none", "parameters of the .geo file"},
    OptionRow{Block::structure, "<structure>_clamp", Kind::names, "names", value("none"), any, "", "physical groups fixed to the ground, in some components only as group:y+rx+rz"},
    OptionRow{Block::structure, "<structure>_rigid", Kind::names, "names", value("none"), any, "", "physical groups that move as one rigid body each"},
    OptionRow{Block::structure, "<structure>_diaphragm", Kind::names, "names", value("none"), any, "", "physical groups of level floors, each rigid in its plane and free to bend out of it"},
    OptionRow{Block::structure, "<structure>_join", Kind::names, "pairs", value("none"), any, "group:group,group:group or none", "each node of the first group and the nearest one of the second become a rigid body: beams below the slabs that they carry"},
    OptionRow{Block::structure, "<structure>_pin", Kind::names, "names", value("none"), any, "", "physical groups whose nodes that lie on each other share their displacements, and turn on their own"},
    OptionRow{Block::structure, "<structure>_levels", Kind::names, "names", value("none"), any, "", "physical groups whose nodes at one height share their displacements: sides of a block of soil that move as the free field"},
    OptionRow{Block::structure, "<structure>_absorbing", Kind::names, "names", value("none"), any, "", "physical groups of faces of solids through which waves leave: dashpots density x speed x area"},
    OptionRow{Block::structure, "<structure>_absorbing_base", Kind::names, "names", value("none"), any, "", "absorbing faces through which the motion enters from below (motion_input below)"},
    OptionRow{Block::structure, "<structure>_tie", Kind::names, "pairs", value("none"), any, "group:group,group:group or none", "each node of the first group follows the nearest facet of the second, or edge: parts whose meshes do not match"},
    OptionRow{Block::structure, "<structure>_ignore", Kind::names, "names", value("none"), any, "", "physical groups of the mesh that are left out on purpose"},
    OptionRow{Block::structure, "<structure>_allow_loose", Kind::boolean, "flag", value("false"), any, "", "pieces that nothing holds, and coincident nodes that nothing joins, are meant"},
    OptionRow{Block::structure, "<structure>_matrices", Kind::text, "folder", value("none"), any, "a folder with dofs.csv, stiffness.mtx, mass.mtx, or none", "its matrices, in place of its elements' own; the mesh says where faces and probes are"},
    OptionRow{Block::structure, "<structure>_model", Kind::choice, "word", value("full"), any, "full|modal", "the finite elements themselves, or a reduction to modes and attachment vectors"},
    OptionRow{Block::structure, "<structure>_modal_vectors", Kind::integer, "-", absent("this or the cut-off"), at_least_1, "", "modal: number of modes, the lowest ones"},
    OptionRow{Block::structure, "<structure>_modal_candidates", Kind::integer, "-", absent("as many as modes"), at_least_1, "", "modal: number of lowest modes computed, of which as many as wanted are kept: the lowest, and those that move the contact points most"},
    OptionRow{Block::structure, "<structure>_modal_cutoff", Kind::real, "Hz", absent("this or the number"), positive, "", "modal: every mode below this frequency"},
    OptionRow{Block::structure, "<structure>_modal_attachment", Kind::boolean, "flag", value("true"), any, "", "modal: static responses to unit forces at the contact dofs beside the modes"},
    OptionRow{Block::structure, "<structure>_modal_residual", Kind::boolean, "flag", value("true"), any, "", "modal: static responses to the motion of the ground beside the modes (residual vectors, missing mass)"},
    OptionRow{Block::structure, "<structure>_modal_ranks", Kind::integer, "-", value("1"), at_least_1, "", "modal: ranks that compute its basis together; more than one need a file for it"},
    OptionRow{Block::structure, "<structure>_modal_patches", Kind::integer, "-", value("0"), patch_count, "", "modal: attachment vectors of so many patches of contact points in place of one each; 0: one each"},
    OptionRow{Block::structure, "<structure>_modal_damping", Kind::reals, "-", absent("left out: that of the structure"), damping_ratio, "a comma-separated list of numbers", "modal: damping ratio of mode 1, 2, ..., the last one for all that follow and for vectors that are no mode"},
    OptionRow{Block::structure, "<structure>_modal_basis", Kind::text, "file", value("none"), any, "a file or none", "modal: where the basis is kept, to be used again while the structure stays the same"},
    OptionRow{Block::structure, "<structure>_mass_scaling", Kind::real, "s", value("0"), not_negative, "", "stable time step for which elements that allow less (not tension-only bars), or fast generalised coordinates, get mass in proportion to their stiffness; 0: none"},
    OptionRow{Block::structure, "<structure>_time_step_target", Kind::real, "s", value("0"), not_negative, "", "stable time step to be reached by mass scaling and by rotational inertia of shells, as far as its frequencies allow; 0: none"},
    OptionRow{Block::structure, "<structure>_target_change", Kind::real, "-", value("1e-3"), fraction, "", "time step target: part by which a frequency may fall"},
    OptionRow{Block::structure, "<structure>_target_frequency", Kind::real, "Hz", value("50"), positive, "", "time step target: frequencies up to this one count"},
    OptionRow{Block::structure, "<structure>_initial_displacement", Kind::reals, "m", value("0,0,0"), any, "three numbers x,y,z", "of every free node at t = 0"},
    OptionRow{Block::structure, "<structure>_initial_velocity", Kind::reals, "m/s", value("0,0,0"), any, "three numbers x,y,z", "of every free node at t = 0"},
    OptionRow{Block::structure, "<structure>_initial_state", Kind::text, "file", value("none"), any, "a file or none", "displacement and velocity of single nodes at t = 0, in place of those of all: a table with a first line of names, node or x,y,z, then some of ux to rz and vx to wz"},
    OptionRow{Block::structure, "<structure>_gravity", Kind::reals, "m/s2", absent("left out: 0,0,-gravity"), any, "three numbers x,y,z", "constant body acceleration; without preload it is applied at once at t = 0"},
    OptionRow{Block::structure, "<structure>_p_delta", Kind::boolean, "flag", value("false"), any, "", "the axial forces of beams and bars at rest turn with them: weight on columns that lean; needs gravity and preload static"},
    OptionRow{Block::structure, "<structure>_damping_alpha", Kind::real, "1/s", value("0"), not_negative, "", "Rayleigh damping, mass term: C = alpha M + beta K"},
    OptionRow{Block::structure, "<structure>_damping_beta", Kind::real, "s", value("0"), not_negative, "", "Rayleigh damping, stiffness term"},
    OptionRow{Block::structure, "<structure>_damping_ratio", Kind::real, "-", absent("optional"), damping_ratio, "", "instead of alpha and beta: damping ratio at two frequencies"},
    OptionRow{Block::structure, "<structure>_damping_frequencies", Kind::reals, "Hz", absent("required with the ratio"), positive, "two numbers f1,f2", "the two frequencies of the damping ratio"},
    OptionRow{Block::structure, "<structure>_damping_factor", Kind::real, "-", value("1"), not_negative, "", "factor on the structure's damping, whichever way it is given: alpha and beta, uniform or modal ratios"},
    OptionRow{Block::structure, "<structure>_stiffness_factor", Kind::real, "-", value("1"), positive, "", "factor on its stiffness: on Young's moduli and springs, or on the squared frequencies of a reduction"},
    OptionRow{Block::structure, "<structure>_damping_uniform", Kind::real, "-", absent("optional"), uniform_ratio, "", "instead of alpha and beta: one damping ratio for every frequency of a band, which hardly shortens the step"},
    OptionRow{Block::structure, "<structure>_damping_band", Kind::reals, "Hz", value("1,400"), positive, "two numbers f1,f2", "uniform damping: the band"},
    OptionRow{Block::structure, "<structure>_damping_filters", Kind::integer, "-", value("3"), filter_count, "", "uniform damping: number of filters that make it; more hold the ratio more closely, or over a wider band"},
    OptionRow{Block::structure, "<structure>_damping_reference", Kind::real, "Hz", absent("left out: the first mode"), positive, "", "uniform damping: frequency at which the stiffness is that of the materials; slower motions find less, faster ones more"},
    OptionRow{Block::structure, "<structure>_soil_mat", Kind::text, "group", value("none"), any, "a physical group or none", "rigid mat on soil: its node nearest to the middle of the group carries springs, dashpots and internal masses of a half-space"},
    OptionRow{Block::structure, "<structure>_soil_table", Kind::text, "file", value("none"), any, "a file of run/soil or none", "soil: springs, dashpots, masses and hidden motions of the mat, in place of those of a half-space, as run/soil fits them to impedances over the frequency"},
    OptionRow{Block::structure, "<structure>_soil_vs", Kind::real, "m/s", absent("required with soil_mat, unless there is a soil_table"), positive, "", "soil: speed of shear waves"},
    OptionRow{Block::structure, "<structure>_soil_density", Kind::real, "kg/m3", absent("required with soil_mat, unless there is a soil_table"), positive, "", "soil: density"},
    OptionRow{Block::structure, "<structure>_soil_poisson", Kind::real, "-", absent("required with soil_mat, unless there is a soil_table"), soil_poisson, "", "soil: Poisson's ratio"},
    OptionRow{Block::structure, "<structure>_soil_shape", Kind::choice, "word", value("rectangle"), any, "rectangle|disk", "soil: shape of the mat's underside"},
    OptionRow{Block::structure, "<structure>_soil_size", Kind::reals, "m", absent("left out: that of the group"), positive, "two sides along x and y, or a diameter", "soil: size of the mat's underside"},
    OptionRow{Block::structure, "<structure>_soil_embedment", Kind::real, "m", value("0"), not_negative, "", "soil: depth of the underside of a rectangle below the surface"},
    OptionRow{Block::structure, "<structure>_soil_frequency_dependence", Kind::boolean, "flag", value("true"), any, "", "soil: internal masses; without them static springs, and dashpots of a0 = 1"},

    OptionRow{Block::region, "<structure>_<group>_element", Kind::choice, "word", required, any, element_words, "element of the group (hex8: with incompatible modes)"},
    OptionRow{Block::region, "<structure>_<group>_material", Kind::text, "name", absent("required but for points and springs"), any, "the name of a material", "its material", for_extents},
    OptionRow{Block::region, "<structure>_<group>_section", Kind::text, "name", absent("required for beam"), any, "the name of a section", "its cross-section (beam only)", for_beams},
    OptionRow{Block::region, "<structure>_<group>_divide", Kind::text, "-", value("none"), any, "none, auto, or a count from 2 to 1000", "lines of the mesh are cut into so many beams of one length; auto: into as many as bending up to the highest of spectra_frequencies needs, 4 in a half wave", for_beams},
    OptionRow{Block::region, "<structure>_<group>_area", Kind::real, "m2", absent("required for bar"), positive, "", "its cross-section area (bar only)", for_bars},
    OptionRow{Block::region, "<structure>_<group>_tension_only", Kind::boolean, "flag", value("false"), any, "", "bar that buckles: it resists stretching only", for_bars},
    OptionRow{Block::region, "<structure>_<group>_thickness", Kind::real, "m", absent("required for shell"), positive, "", "its thickness (shell only)", for_shells},
    OptionRow{Block::region, "<structure>_<group>_rotary_inertia_factor", Kind::real, "-", value("0"), not_negative, "", "shell: rotary inertia of a node at least its mass x this x element area; 0.125 frees the step from thin shells", for_shells},
    OptionRow{Block::region, "<structure>_<group>_drilling_factor", Kind::real, "-", value("1"), positive, "", "shell: stiffness against turning about the normal, over G t; 0.1 is closer and has a longer step", for_shells},
    OptionRow{Block::region, "<structure>_<group>_mass_per_area", Kind::real, "kg/m2", value("0"), not_negative, "", "load on a shell with mass and no stiffness", for_shells},
    OptionRow{Block::region, "<structure>_<group>_mass_per_length", Kind::real, "kg/m", value("0"), not_negative, "", "load on a beam or bar with mass and no stiffness", for_beams_and_bars},
    OptionRow{Block::region, "<structure>_<group>_mass", Kind::real, "kg", absent("required for point_mass"), positive, "", "mass added at each point of the group", for_points},
    OptionRow{Block::region, "<structure>_<group>_rotary_inertia", Kind::reals, "kg m2", value("0,0,0"), not_negative, "three numbers about x, y, z", "point_mass: its rotary inertia", for_points},
    OptionRow{Block::region, "<structure>_<group>_stiffness", Kind::reals, "N/m, N m", absent("required for springs"), not_negative, "six numbers along and about x, y, z (three: no rotations)", "of grounded_spring and spring", for_springs},
    OptionRow{Block::region, "<structure>_<group>_dashpot", Kind::reals, "N s/m, N m s", value("0,0,0,0,0,0"), not_negative, "six numbers along and about x, y, z", "dashpot beside the spring", for_springs},
    OptionRow{Block::region, "<structure>_<group>_stiffness_per_area", Kind::reals, "N/m3", value("0,0,0"), not_negative, "three numbers along x, y, z", "grounded_spring on surfaces: its stiffness per area", for_grounded},
    OptionRow{Block::region, "<structure>_<group>_dashpot_per_area", Kind::reals, "N s/m3", value("0,0,0"), not_negative, "three numbers along x, y, z", "grounded_spring on surfaces: its dashpots per area", for_grounded},
    OptionRow{Block::region, "<structure>_<group>_stiffness_per_length", Kind::reals, "N/m2", value("0,0,0"), not_negative, "three numbers along x, y, z", "grounded_spring on lines: its stiffness per length", for_grounded},
    OptionRow{Block::region, "<structure>_<group>_dashpot_per_length", Kind::reals, "N s/m2", value("0,0,0"), not_negative, "three numbers along x, y, z", "grounded_spring on lines: its dashpots per length", for_grounded},
    OptionRow{Block::region, "<structure>_<group>_compression_only", Kind::boolean, "flag", value("false"), any, "", "grounded_spring from which a mat may lift off: along z, spring and dashpot resist pressing down only", for_grounded},
    OptionRow{Block::region, "<structure>_<group>_dashpot_exponent", Kind::real, "-", value("1"), dashpot_power, "", "power of the rate to which its dashpots go; their unit is N (s/m)^it", for_springs},
    OptionRow{Block::region, "<structure>_<group>_dashpot_stiffness", Kind::reals, "N/m, N m", value("0,0,0,0,0,0"), not_negative, "six numbers along and about x, y, z", "spring in series with each dashpot; 0: none, it is rigid", for_springs},
    OptionRow{Block::region, "<structure>_<group>_series_stiffness", Kind::reals, "N/m, N m", value("0,0,0,0,0,0"), not_negative, "six numbers along and about x, y, z", "spring in series with its spring and dashpot together; 0: none, it is rigid", for_springs},
    OptionRow{Block::region, "<structure>_<group>_yield_force", Kind::reals, "N, N m", value("0"), not_negative, "one number (bar), or three or six along and about x, y, z", "force at which it yields; 0: never", for_bars_and_springs},
    OptionRow{Block::region, "<structure>_<group>_hardening", Kind::real, "-", value("0"), below_1, "", "stiffness after yield over that before", for_bars_and_springs},
    OptionRow{Block::region, "<structure>_<group>_rule", Kind::choice, "word", value("kinematic"), any, rule_words, "way back from the skeleton and towards it again of a spring or bar that yields, see docs/reference/nonlinear.md", for_bars_and_springs},
    OptionRow{Block::region, "<structure>_<group>_skeleton", Kind::reals, "m, N", absent("left out: yield_force and hardening"), not_negative, "pairs e1,f1,e2,f2,...", "corners of force over elongation (of a bar: over its strain), the first one on the line of the stiffness, the last one followed by hardening", for_bars_and_springs},
    OptionRow{Block::region, "<structure>_<group>_skeleton_back", Kind::reals, "m, N", absent("left out: as skeleton"), not_negative, "pairs e1,f1,e2,f2,..., or 0", "corners in the other direction; 0: it carries nothing there and leaves a gap", for_bars_and_springs},
    OptionRow{Block::region, "<structure>_<group>_shear_skeleton_y", Kind::reals, "-, N", absent("left out: elastic"), not_negative, "pairs g1,Q1,g2,Q2,...", "beam that yields in shear: corners of the force along local y over the shear strain, the first one on the line of G A", for_beams},
    OptionRow{Block::region, "<structure>_<group>_shear_skeleton_z", Kind::reals, "-, N", absent("left out: elastic"), not_negative, "pairs g1,Q1,g2,Q2,...", "likewise along local z", for_beams},
    OptionRow{Block::region, "<structure>_<group>_shear_skeleton", Kind::reals, "-, Pa", absent("left out: elastic"), not_negative, "pairs g1,t1,g2,t2,...", "shell that yields in shear in its plane: corners of the shear stress over the shear strain, the first one on the line of G", for_shells},
    OptionRow{Block::region, "<structure>_<group>_shear_rule", Kind::choice, "word", value("straight"), any, rule_words, "its rule, see rule", for_beams_and_shells},
    OptionRow{Block::region, "<structure>_<group>_bending_skeleton_y", Kind::reals, "1/m, N m", absent("left out: elastic"), not_negative, "pairs k1,M1,k2,M2,...", "beam that yields in bending: corners of the moment about local y over the curvature, the first one on the line of E I", for_beams},
    OptionRow{Block::region, "<structure>_<group>_bending_skeleton_z", Kind::reals, "1/m, N m", absent("left out: elastic"), not_negative, "pairs k1,M1,k2,M2,...", "likewise about local z", for_beams},
    OptionRow{Block::region, "<structure>_<group>_bending_rule", Kind::choice, "word", value("bending"), any, rule_words, "its rule, see rule", for_beams},
    OptionRow{Block::region, "<structure>_<group>_bending_axial", Kind::reals, "N, -", absent("left out: none"), positive, "N_y or N_y,a", "an axial force N leaves 1 - (|N| / N_y)^a of the strength in bending, a 1 unless given; with bending_rule kinematic", for_beams},
    OptionRow{Block::region, "<structure>_<group>_cracking_force", Kind::real, "N/m", absent("left out: elastic"), positive, "", "shell that cracks by damage: force per length in tension along one axis at which it begins", for_shells},
    OptionRow{Block::region, "<structure>_<group>_cracking_moment", Kind::real, "N", absent("left out: cracking_force thickness / 6"), positive, "", "its moment per length about one axis at which damage begins", for_shells},
    OptionRow{Block::region, "<structure>_<group>_cracked_tension", Kind::real, "-", absent("required with cracking_force"), below_1, "", "slope of its force while it cracks in tension, over that of the sound shell", for_shells},
    OptionRow{Block::region, "<structure>_<group>_cracked_compression", Kind::real, "-", value("1"), up_to_1, "", "likewise in compression; 1: no damage by it", for_shells},
    OptionRow{Block::region, "<structure>_<group>_cracked_bending", Kind::real, "-", absent("left out: cracked_tension"), below_1, "", "likewise in bending", for_shells},
    OptionRow{Block::region, "<structure>_<group>_unloading_exponent", Kind::real, "-", absent("left out: 0, of bending 0.5"), up_to_1, "", "peak, pinching, bending: stiffness of unloading over the first one is this power of the secant over it", for_yielding},
    OptionRow{Block::region, "<structure>_<group>_unloading_least", Kind::real, "-", value("0"), up_to_1, "", "peak, pinching, bending, origin: least stiffness of unloading over the first one", for_yielding},
    OptionRow{Block::region, "<structure>_<group>_pinch", Kind::reals, "-", absent("required with pinching"), up_to_1, "two numbers force,way", "pinching: corner on the way to the farthest point, as parts of its force and of the way there", for_yielding},
    OptionRow{Block::region, "<structure>_<group>_deterioration", Kind::reals, "J, -", absent("left out: none"), positive, "energy, or energy,exponent", "peak, pinching: energy that it can lose before its strength is gone (of a bar per length), and exponent of its going", for_yielding},
    OptionRow{Block::region, "<structure>_<group>_yield_circle", Kind::choice, "word", value("none"), any, "none|x+y|y+z|x+z", "translations that yield together: a bearing's shear", for_springs},
    OptionRow{Block::region, "<structure>_<group>_sliding_friction", Kind::real, "-", value("0"), Range{0, 10, false, false}, "", "sliding bearing: the circle yields at this times the compression across it", for_springs},
    OptionRow{Block::region, "<structure>_<group>_pendulum_radius", Kind::real, "m", value("0"), not_negative, "", "friction pendulum: radius of its dish, whose slope follows the compression; hardening bounds it; 0: hardening is the slope", for_springs},
    OptionRow{Block::region, "<structure>_<group>_slack", Kind::real, "m", value("0"), not_negative, "", "tension_only bar: stretched so far before it pulls (a hook, a cable that sags)", for_bars},
    OptionRow{Block::region, "<structure>_<group>_damping_alpha", Kind::real, "1/s", absent("left out: that of the structure"), not_negative, "", "Rayleigh damping of its elements, mass term"},
    OptionRow{Block::region, "<structure>_<group>_damping_beta", Kind::real, "s", absent("left out: that of the structure"), not_negative, "", "Rayleigh damping of its elements, stiffness term"},
    OptionRow{Block::region, "<structure>_<group>_damping_ratio", Kind::real, "-", absent("optional"), damping_ratio, "", "instead of alpha and beta: damping ratio at two frequencies"},
    OptionRow{Block::region, "<structure>_<group>_damping_frequencies", Kind::reals, "Hz", absent("required with the ratio"), positive, "two numbers f1,f2", "the two frequencies of the damping ratio"},
    OptionRow{Block::region, "<structure>_<group>_initial_displacement", Kind::reals, "m", absent("left out: that of the structure"), any, "three numbers x,y,z", "of every free node of the group at t = 0"},
    OptionRow{Block::region, "<structure>_<group>_initial_velocity", Kind::reals, "m/s", absent("left out: that of the structure"), any, "three numbers x,y,z", "of every free node of the group at t = 0"},

    OptionRow{Block::material, "material_<material>_young", Kind::real, "Pa", required, positive, "", "Young's modulus"},
    OptionRow{Block::material, "material_<material>_poisson", Kind::real, "-", required, poisson_ratio, "", "Poisson's ratio"},
    OptionRow{Block::material, "material_<material>_density", Kind::real, "kg/m3", required, not_negative, "", "density; 0: none, for beams and bars, whose mass is that of their length or of points"},

    OptionRow{Block::section, "section_<section>_profile", Kind::text, "name", absent("left out: its own name, if that is one"), any, "a standard section: HEB160, IPE300, UPN200, W14x132, SHS100x5, HSS8x8x1/2, RECT600x400, ROUND50", "standard section whose numbers it takes where the next five are left out"},
    OptionRow{Block::section, "section_<section>_area", Kind::real, "m2", required, positive, "", "area"},
    OptionRow{Block::section, "section_<section>_inertia_y", Kind::real, "m4", required, positive, "", "second moment about local y (bending in local x-z)"},
    OptionRow{Block::section, "section_<section>_inertia_z", Kind::real, "m4", required, positive, "", "second moment about local z (bending in local x-y)"},
    OptionRow{Block::section, "section_<section>_torsion", Kind::real, "m4", required, positive, "", "St-Venant torsion constant"},
    OptionRow{Block::section, "section_<section>_shear_area", Kind::reals, "m2", absent("left out: of its profile, or no flexibility in shear"), positive, "two numbers y,z", "areas that bear shear along local y and along local z"},
    OptionRow{Block::section, "section_<section>_z_axis", Kind::reals, "-", required, any, "three numbers x,y,z, not all zero", "direction of local z in global axes"},

    OptionRow{Block::contact, "<contact>_secondary", Kind::text, "group", required, any, "structure:group", "secondary side, a surface of a structure"},
    OptionRow{Block::contact, "<contact>_primary", Kind::text, "group", required, any, "structure:group, or wall", "primary side, the surface that it faces; wall: rigid, parallel to the secondary"},
    OptionRow{Block::contact, "<contact>_gap", Kind::text, "m", value("geometry"), any, "geometry, or one, two or four numbers g1,g2,...", "initial gap: uniform, linear, or at the four corners"},
    OptionRow{Block::contact, "<contact>_gap_deviation", Kind::real, "m", value("0"), not_negative, "", "standard deviation of a random part of the gap over the face, as tolerances of building make it; 0: none"},
    OptionRow{Block::contact, "<contact>_gap_length", Kind::real, "m", absent("required with gap_deviation"), positive, "", "length over which that part is correlated: its covariance falls with exp(-distance/length)"},
    OptionRow{Block::contact, "<contact>_gap_seed", Kind::integer, "-", value("1"), any, "", "seed of that part: another number, another joint of the same tolerances"},
    OptionRow{Block::contact, "<contact>_gap_patches", Kind::text, "m", value("none"), any, "none, or discs s,t,radius,gap and rectangles s1,t1,s2,t2,gap between semicolons", "parts of the face with a gap of their own, in place of all others, as debris or formwork left in makes them; s and t are places along the tangent axes, in the order x, y, z, and a gap of 0 is a joint that is filled"},
    OptionRow{Block::contact, "<contact>_gap_at", Kind::choice, "word", value("auto"), any, "auto|rest|unloaded", "with preload static: the state in which the joint has its gap, at rest under the weight or unloaded as the meshes are; auto: at rest where the gap is given and positive everywhere, not beside a wall"},
    OptionRow{Block::contact, "<contact>_passes", Kind::choice, "word", value("auto"), any, "auto|1|2", "2: nodes of the primary side are kept out of the secondary as well; auto: where either side holds lines, or the facets of the secondary are larger"},
    OptionRow{Block::contact, "<contact>_friction", Kind::real, "-", value("0"), Range{0, 10, false, false}, "", "Coulomb's coefficient of friction; 0: smooth"},
    OptionRow{Block::contact, "<contact>_sliding", Kind::real, "m", value("0"), not_negative, "", "how far the two faces may slide along each other: pairs are found anew as they do; 0: pairs stay those of the start"},
    OptionRow{Block::contact, "<contact>_filler", Kind::text, "-:Pa", value("none"), any, "strain:pressure,strain:pressure,... or none", "filler of the joint, foam or board: pressure under first loading, from 0:0 on; hard contact begins at the last strain"},
    OptionRow{Block::contact, "<contact>_filler_unloading", Kind::real, "Pa", absent("required with filler"), positive, "", "filler: slope of pressure over strain on which it unloads and loads again, at least the steepest of the table"},
    OptionRow{Block::contact, "<contact>_filler_thickness", Kind::real, "m", absent("left out: the gap"), positive, "", "filler: its thickness; less than the gap: it begins to press where the rest of the gap is closed"},
    OptionRow{Block::contact, "<contact>_filler_area", Kind::real, "m2", absent("left out: that of the faces"), positive, "", "filler: its area, shared out to the pairs in proportion to their parts of the face; needed where faces are lines"},
    OptionRow{Block::contact, "<contact>_crushing", Kind::real, "Pa", absent("left out: the faces are hard"), positive, "", "faces that are crushed: strength of the strip that gives way where they strike, elastic up to it; hard contact begins where it is crushed to the last"},
    OptionRow{Block::contact, "<contact>_crushing_stiffness", Kind::real, "N/m3", absent("required with crushing"), positive, "", "crushing: pressure over closing up to the strength, and on unloading"},
    OptionRow{Block::contact, "<contact>_crushing_depth", Kind::real, "m", absent("required with crushing"), positive, "", "crushing: depth of the strip, of both faces together, that can be crushed before they are hard"},
    OptionRow{Block::contact, "<contact>_crushing_area", Kind::real, "m2", absent("left out: that of the faces"), positive, "", "crushing: its area, shared out to the pairs in proportion to their parts of the face; needed where faces are lines"},
    OptionRow{Block::contact, "<contact>_along", Kind::text, "-", absent("left out: the sides are faces"), any, "a direction x,y,z, or line", "stop between nodes: its sides are nodes, groups of them or points structure:x,y,z, and this is the direction in which the primary lies beyond the secondary; line: that from one to the other. Two gaps stop both ways: until they have come together by the first, and parted by the second"},
    OptionRow{Block::contact, "<contact>_stiffness", Kind::real, "N/m", absent("left out: it is hard"), positive, "", "stop: spring beyond its gap, between each two nodes"},
    OptionRow{Block::contact, "<contact>_dashpot", Kind::real, "N s/m", value("0"), not_negative, "", "stop with a stiffness: dashpot beside it, while both press"},

    OptionRow{Block::motion, "motion_<x|y|z>_record", Kind::text, "file", value("none"), any, "a file or none", "recorded accelerogram; none: no motion; wins over a target"},
    OptionRow{Block::motion, "motion_<x|y|z>_unit", Kind::choice, "word", value("auto"), any, "auto|g|m/s2|cm/s2|mm/s2", "unit of the record; auto: from the header of the file"},
    OptionRow{Block::motion, "motion_<x|y|z>_time_step", Kind::real, "s", value("0"), not_negative, "", "time step of the record; 0: from the file; needed where it is above 0.1 s"},
    OptionRow{Block::motion, "motion_<x|y|z>_column", Kind::integer, "-", value("0"), not_negative, "", "column of the acceleration, from 1, or which of the components of a file that holds several; 0: the only one"},
    OptionRow{Block::motion, "motion_<x|y|z>_target", Kind::text, "file", absent("optional"), any, "a file", "synthetic motion: file of its target spectrum; needs a pga"},
    OptionRow{Block::motion, "motion_<x|y|z>_seed", Kind::integer, "-", value("1"), not_negative, "", "synthetic motion: seed of the phases"},
    OptionRow{Block::motion, "motion_<x|y|z>_duration", Kind::real, "s", value("25"), positive, "", "synthetic motion: duration"},
    OptionRow{Block::motion, "motion_<x|y|z>_envelope", Kind::reals, "s", value("2,15"), not_negative, "two numbers t1,t2 with t1 <= t2 <= duration", "synthetic motion: end of the rise, start of the decay"},
    OptionRow{Block::motion, "motion_<x|y|z>_pga", Kind::real, "m/s2", value("0"), not_negative, "", "peak ground acceleration to scale to; 0: as recorded"},
    OptionRow{Block::motion, "motion_<x|y|z>_scale", Kind::real, "-", value("1"), any, "", "factor on the record, where no pga is given"},

    OptionRow{Block::support, "<support>_groups", Kind::text, "groups", required, any, "structure:group,structure", "its groups with clamped nodes, or a structure with all its ground, springs and soil included"},
    OptionRow{Block::support, "<support>_delay", Kind::real, "s", value("0"), not_negative, "", "time by which the motion of the ground arrives there later"},
    OptionRow{Block::support, "<support>_factor", Kind::reals, "-", value("1,1,1"), any, "three numbers along x, y, z", "factors on the motion of the ground there"},
    OptionRow{Block::support, "<support>_point", Kind::reals, "m", absent("required with a rotation or an embedment"), any, "three numbers x,y,z", "point about which it turns"},
    OptionRow{Block::support, "<support>_embedment", Kind::real, "m", value("0"), not_negative, "", "depth of a rigid foundation below the surface: along and about x and y it moves as one does in vertical shear waves that give the surface the motion of the ground; 0: it is not embedded"},
    OptionRow{Block::support, "<support>_vs", Kind::real, "m/s", absent("required with an embedment"), positive, "", "speed of shear waves in the soil around it"},
    OptionRow{Block::support, "<support>_half_width", Kind::real, "m", absent("required with an embedment"), positive, "", "half a side of the foundation, or its radius"},
    OptionRow{Block::support_motion, "<support>_motion_<x|y|z>_record", Kind::text, "file", absent("left out: the motion of the ground"), any, "a file or none", "its own accelerogram along this axis; none: it is at rest; wins over a target"},
    OptionRow{Block::support_motion, "<support>_motion_<x|y|z>_unit", Kind::choice, "word", value("auto"), any, "auto|g|m/s2|cm/s2|mm/s2", "unit of the record; auto: from the header of the file"},
    OptionRow{Block::support_motion, "<support>_motion_<x|y|z>_time_step", Kind::real, "s", value("0"), not_negative, "", "time step of the record; 0: from the file; needed where it is above 0.1 s"},
    OptionRow{Block::support_motion, "<support>_motion_<x|y|z>_column", Kind::integer, "-", value("0"), not_negative, "", "column of the acceleration, from 1, or which of the components of a file that holds several; 0: the only one"},
    OptionRow{Block::support_motion, "<support>_motion_<x|y|z>_target", Kind::text, "file", absent("optional"), any, "a file", "synthetic motion: file of its target spectrum; needs a pga"},
    OptionRow{Block::support_motion, "<support>_motion_<x|y|z>_seed", Kind::integer, "-", value("1"), not_negative, "", "synthetic motion: seed of the phases"},
    OptionRow{Block::support_motion, "<support>_motion_<x|y|z>_duration", Kind::real, "s", value("25"), positive, "", "synthetic motion: duration"},
    OptionRow{Block::support_motion, "<support>_motion_<x|y|z>_envelope", Kind::reals, "s", value("2,15"), not_negative, "two numbers t1,t2 with t1 <= t2 <= duration", "synthetic motion: end of the rise, start of the decay"},
    OptionRow{Block::support_motion, "<support>_motion_<x|y|z>_pga", Kind::real, "m/s2", value("0"), not_negative, "", "peak ground acceleration to scale to; 0: as recorded"},
    OptionRow{Block::support_motion, "<support>_motion_<x|y|z>_scale", Kind::real, "-", value("1"), any, "", "factor on the record, where no pga is given"},
    OptionRow{Block::support_rotation, "<support>_rotation_<x|y|z>_record", Kind::text, "file", absent("left out: it does not turn"), any, "a file", "record of its angular acceleration about this axis, in rad/s2"},
    OptionRow{Block::support_rotation, "<support>_rotation_<x|y|z>_time_step", Kind::real, "s", value("0"), not_negative, "", "time step of the record; 0: from the file; needed where it is above 0.1 s"},
    OptionRow{Block::support_rotation, "<support>_rotation_<x|y|z>_column", Kind::integer, "-", value("0"), not_negative, "", "column of the acceleration, from 1, or which of the components of a file that holds several; 0: the only one"},
    OptionRow{Block::support_rotation, "<support>_rotation_<x|y|z>_scale", Kind::real, "-", value("1"), any, "", "factor on the record"},

    OptionRow{Block::load, "<load>_on", Kind::text, "group", required, any, "structure:group", "the group that it acts on"},
    OptionRow{Block::load, "<load>_force", Kind::reals, "N", absent("optional"), any, "three numbers along x, y, z", "force on each node of the group"},
    OptionRow{Block::load, "<load>_moment", Kind::reals, "N m", absent("optional"), any, "three numbers about x, y, z", "moment on each node of the group"},
    OptionRow{Block::load, "<load>_line_force", Kind::reals, "N/m", absent("optional"), any, "three numbers along x, y, z", "force per length of the lines of the group; of beams with the moments at their ends that it has when they are held"},
    OptionRow{Block::load, "<load>_surface_force", Kind::reals, "N/m2", absent("optional"), any, "three numbers along x, y, z", "force per area of the surfaces of the group"},
    OptionRow{Block::load, "<load>_pressure", Kind::real, "N/m2", absent("optional"), any, "", "pressure onto the surfaces of the group: into the solid behind them, of shells against the normal of the order of their nodes"},
    OptionRow{Block::load, "<load>_body_force", Kind::reals, "N/m3", absent("optional"), any, "three numbers along x, y, z", "force per volume of the elements of the group"},
    OptionRow{Block::load, "<load>_factor", Kind::real, "-", value("1"), any, "", "factor on all of these"},
    OptionRow{Block::load, "<load>_function", Kind::choice, "word", value("constant"), any, "constant|step|ramp|harmonic", "history: 1 all the time, before the run as well; 0, then 1 from start on; from 0 at start to 1 after rise; a sine from start on"},
    OptionRow{Block::load, "<load>_table", Kind::text, "file", absent("optional"), any, "a file", "history: a text file of two columns, time in s and value, linear between; before the first and after the last time their values"},
    OptionRow{Block::load, "<load>_values", Kind::text, "s,-", absent("optional"), any, "pairs t,value; t,value with increasing t", "history: such a table in place"},
    OptionRow{Block::load, "<load>_start", Kind::real, "s", value("0"), not_negative, "", "step, ramp, harmonic: time at which it sets in"},
    OptionRow{Block::load, "<load>_rise", Kind::real, "s", absent("required with a ramp"), positive, "", "ramp: time from 0 to 1"},
    OptionRow{Block::load, "<load>_frequency", Kind::real, "Hz", absent("required with a harmonic load"), positive, "", "harmonic: its frequency"},
    OptionRow{Block::load, "<load>_phase", Kind::real, "rad", value("0"), any, "", "harmonic: phase at start"},

    OptionRow{Block::probe, "<probe>_structure", Kind::text, "name", required, any, "the name of a structure", "the structure that it sits on"},
    OptionRow{Block::probe, "<probe>_at", Kind::text, "m", absent("this or group"), any, "points x,y,z; x,y,z", "points, each snapped to the nearest node"},
    OptionRow{Block::probe, "<probe>_group", Kind::text, "group", absent("this or at"), any, "a physical group", "all nodes of a physical group"},
    OptionRow{Block::probe, "<probe>_average", Kind::boolean, "flag", value("true"), any, "", "one averaged record instead of one per node"},
    OptionRow{Block::probe, "<probe>_floor", Kind::boolean, "flag", value("false"), any, "", "it records the motion of a floor: drifts are those between floors"},

    OptionRow{Block::force, "<force>_structure", Kind::text, "name", required, any, "the name of a structure", "the structure that they are of"},
    OptionRow{Block::force, "<force>_kind", Kind::choice, "word", required, any, "reactions|storey|members|shells|cut", "reactions: forces of the ground on it; storey: forces through a level; members: at the ends of beams, bars and springs; shells: forces and moments per length at their centres; cut: forces of a group through a plane"},
    OptionRow{Block::force, "<force>_level", Kind::real, "m", absent("storey and cut only"), any, "", "z of the level; of a cut its distance from the origin along the normal"},
    OptionRow{Block::force, "<force>_normal", Kind::reals, "-", absent("left out: 0,0,1"), any, "three numbers x,y,z, not all zero", "cut: normal of its plane, which points to the side that the force acts on"},
    OptionRow{Block::force, "<force>_about", Kind::reals, "m", absent("left out: the origin, of a storey or cut the point of its plane nearest to it"), any, "three numbers x,y,z", "point that the moments are about"},
    OptionRow{Block::force, "<force>_group", Kind::text, "group", absent("members, shells and cut only"), any, "a physical group", "the elements"},
    OptionRow{Block::force, "<force>_at", Kind::text, "m", absent("left out: peaks of all of them, no history"), any, "points x,y,z; x,y,z", "the element of the group nearest to each point, with its history"},

    OptionRow{Block::equipment, "<equipment>_probe", Kind::text, "name", required, any, "the name of a probe", "the probe at the place where it is mounted"},
    OptionRow{Block::equipment, "<equipment>_direction", Kind::choice, "word", value("all"), any, "x|y|z|horizontal|all", "directions of the motion that its capacity holds for, each by itself"},
    OptionRow{Block::equipment, "<equipment>_capacity", Kind::text, "file", required, any, "a file of frequency and acceleration", "its test response spectrum: a text file of two columns, frequency in Hz and acceleration, linear between in logarithms; frequencies beyond it do not count"},
    OptionRow{Block::equipment, "<equipment>_capacity_unit", Kind::choice, "word", required, any, "m/s2|g", "unit of the accelerations of that file"},
    OptionRow{Block::equipment, "<equipment>_damping", Kind::real, "-", value("0.05"), damping_ratio, "", "damping ratio of both spectra, one of spectra_damping"},
    OptionRow{Block::equipment, "<equipment>_margin", Kind::real, "-", value("0.1"), not_negative, "", "margin: it passes where its capacity is 1 + margin times what is required"},
    OptionRow{Block::equipment, "<equipment>_broadening", Kind::real, "-", value("0.15"), below_1, "", "part by which the floor's spectrum is widened to both sides before, for the uncertainty of the building's frequencies"},
    OptionRow{Block::equipment, "<equipment>_band", Kind::reals, "Hz", absent("all that both spectra have"), positive, "two frequencies low,high", "frequencies that count"},
    OptionRow{Block::equipment, "<equipment>_high_band", Kind::reals, "Hz", value("20,40"), positive, "two frequencies low,high", "frequencies whose smallest ratio is reported apart: relays and contactors chatter there"},
    OptionRow{Block::equipment, "<equipment>_dip", Kind::real, "-", value("0"), below_1, "", "part of the required ratio that may lack where the frequencies a sixth of an octave below and above have all of it"},

    OptionRow{Block::equipment, "<equipment>_cabinet_frequency", Kind::real, "Hz", absent("left out: it is mounted on the floor"), positive, "", "frequency of the cabinet in which it is mounted, an oscillator on the floor"},
    OptionRow{Block::equipment, "<equipment>_cabinet_damping", Kind::real, "-", value("0.05"), damping_ratio, "", "damping ratio of the cabinet"},

    OptionRow{Block::spectra, "spectra_damping", Kind::reals, "-", value("0.05"), damping_ratio, "a comma-separated list of numbers", "damping ratios of the oscillators", {}, free_on_restart},
    OptionRow{Block::spectra, "spectra_frequencies", Kind::text, "Hz", value("0.5:400:200log"), positive, "start:stop:COUNTlog, start:stop:COUNTlin (COUNT 2 to 100000) or an increasing list", "frequencies of the oscillators", {}, free_on_restart},
    OptionRow{Block::spectra, "spectra_start", Kind::real, "s", value("0"), not_negative, "", "time from which spectra and peak values count: the oscillators are at rest then", {}, free_on_restart},
    OptionRow{Block::spectra, "peak_frequency", Kind::real, "Hz", value("0"), not_negative, "", "peaks of acceleration are those after a low-pass at this frequency; 0: the highest of spectra_frequencies", {}, free_on_restart},
};
// clang-format on

}  // namespace

bool Range::contains(double number) const {
  const bool above = low_open ? number > low : number >= low;
  const bool below = high_open ? number < high : number <= high;
  return above && below;
}

std::string Range::text() const {
  const auto number = [](double bound) {
    std::string digits = std::to_string(bound);
    digits.erase(digits.find_last_not_of('0') + 1);
    return digits.back() == '.' ? digits.substr(0, digits.size() - 1) : digits;
  };
  if (low == -infinity && high == infinity) return "any";
  if (high == infinity) return (low_open ? "> " : ">= ") + number(low);
  return (low_open ? "(" : "[") + number(low) + ", " + number(high) + (high_open ? ")" : "]");
}

std::span<const OptionRow> option_table() {
  return option_rows;
}

const OptionRow& option_row(std::string_view pattern) {
  const auto table = pattern.starts_with('-') ? spectra_option_table() : option_table();
  const auto row = std::ranges::find(table, pattern, &OptionRow::pattern);
  if (row == table.end()) {
    throw std::logic_error("no option has the pattern " + std::string(pattern));
  }
  return *row;
}

std::string option_name(std::string_view pattern, const std::vector<std::string>& names) {
  std::string result;
  auto name = names.begin();
  while (true) {
    const std::size_t open = pattern.find('<');
    result += pattern.substr(0, open);
    if (open == std::string_view::npos) break;
    if (name == names.end()) {
      throw std::logic_error("a placeholder without a name in " + std::string(pattern));
    }
    result += *name++;
    pattern.remove_prefix(pattern.find('>') + 1);
  }
  if (name != names.end()) throw std::logic_error("more names than placeholders for " + result);
  return result;
}

std::optional<std::string> match_option(std::string_view pattern, std::string_view name) {
  const std::string_view head = pattern.substr(0, pattern.find('<'));
  const std::string_view tail = pattern.substr(pattern.find('>') + 1);
  if (name.size() <= head.size() + tail.size() || !name.starts_with(head) ||
      !name.ends_with(tail)) {
    return std::nullopt;
  }
  return std::string(name.substr(head.size(), name.size() - head.size() - tail.size()));
}

std::string expected_text(const OptionRow& row) {
  const bool ranged = row.range.text() != "any";
  const std::string unit = " [" + std::string(row.unit) + "]";
  const std::string range = ranged ? " " + row.range.text() : "";
  const std::string within = (ranged && range[1] != '>' ? " in" : "") + range;
  switch (row.kind) {
    case Kind::names:
      return row.preset.required ? "a comma-separated list of at least one name"
                                 : "a comma-separated list of names, or none";
    case Kind::choice: {
      std::string words(row.form);
      std::ranges::replace(words, '|', ' ');
      return words.find(' ') == std::string::npos ? words + " (the only one supported now)"
                                                  : "one of: " + words;
    }
    case Kind::boolean:
      return "true or false";
    case Kind::integer:
      return "an integer" + within + unit;
    case Kind::real:
      return "a number" + within + unit;
    case Kind::text:
    case Kind::reals:
      break;
  }
  const bool numeric = row.kind == Kind::reals || ranged || row.unit == "m";
  return std::string(row.form) + (ranged ? ", each" + within : "") + (numeric ? unit : "");
}

bool may_differ(std::string_view name, Comparison comparison) {
  if (is_petsc_option(name)) return true;
  const auto row = std::ranges::find(option_rows, name, &OptionRow::pattern);
  return row != option_rows.end() && row->free.contains(comparison);
}

}  // namespace pounding
