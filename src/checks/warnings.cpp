#include "checks/warnings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "checks/model_doubts.h"
#include "common/facts.h"
#include "common/parallel.h"
#include "model/start_at_rest.h"
#include "model/time_step.h"
#include "scene/option_table.h"
#include "scene/option_values.h"
#include "stability/stable_time_step.h"

namespace pounding {
namespace {

/// Rayleigh damping above half of the critical one at one of these frequencies [Hz].
void doubt_rayleigh(const std::string& owner, const Rayleigh& damping,
                    const std::vector<double>& frequencies, Doubts doubts) {
  constexpr double doubtful_share = 0.5;
  for (const double frequency : frequencies) {
    const double ratio = damping_ratio(damping, 2 * std::numbers::pi * frequency);
    if (!(ratio > doubtful_share) || !(frequency > 0)) continue;
    doubts.add(owner,
               "alpha {:.4g} 1/s and beta {:.4g} s damp {:.4g %} of critical at {:.4g} Hz; "
               "are they meant? -damping_ratio with two frequencies is surer",
               {damping.alpha, damping.beta, ratio, frequency});
    return;
  }
}

/// Uniform damping whose filters are too few, or whose band is too narrow for the modes.
/// A mode of the water of a pool, which is damped by itself.
bool is_wave(const Structure& structure, const Mode& mode) {
  const int region = mode.region.region;
  return region >= 0 && structure.regions[static_cast<std::size_t>(region)].of_water;
}

void doubt_uniform(const Structure& structure, const std::vector<Mode>& modes, Doubts doubts) {
  constexpr double large_ripple = 0.2;
  constexpr double doubtful_part = 0.8;
  const UniformDamping& uniform = *structure.uniform_damping;
  const std::string& name = structure.name;
  if (uniform.ripple > large_ripple) {
    doubts.add("structure " + name,
               "{} filters hold the uniform damping within {:.3g %} of its ratio only; give "
               "more -{}_damping_filters, or a narrower band",
               {uniform.filters.size(), uniform.ripple, name});
  }
  for (const Mode& mode : modes) {
    const double found = uniform.ratio_at(2 * std::numbers::pi * mode.frequency);
    const bool inside = mode.frequency >= uniform.lowest && mode.frequency <= uniform.highest;
    if (!mode.location.empty() || inside || found >= doubtful_part * uniform.ratio) continue;
    if (is_wave(structure, mode)) continue;
    doubts.add("structure " + name,
               "a mode of {:.3g} Hz lies outside of the band of its uniform damping and has "
               "{:.3g %} of critical instead of {:.3g %}; give a wider -{}_damping_band",
               {mode.frequency, found, uniform.ratio, name});
    return;
  }
}

constexpr double nearly = 1 + 1e-9;

bool stands_still(const Scene& scene) {
  const Vector3 zero{0, 0, 0};
  const bool shaken = std::ranges::any_of(
      scene.motion, [](const auto& component) { return component.has_value(); });
  return !shaken && scene.loads.empty() &&
         std::ranges::all_of(scene.structures, [&zero](const Structure& structure) {
           return !structure.starts_displaced() && !structure.starts_in_motion() &&
                  structure.gravity == zero;
         });
}

const Accelerogram& samples(const Model& model, int direction) {
  return model.motion->from_below() ? model.motion->incident(direction)
                                    : model.motion->component(direction);
}

/// A record of its own that ends before the run. Synthetic motions are made as long as asked.
void add_short_record(const Scene& scene, const Model& model, int direction, Doubts doubts) {
  const Accelerogram& component = samples(model, direction);
  const auto& asked = scene.motion[direction];
  const double last = component.end();
  if (std::holds_alternative<RecordedMotion>(asked->source) &&
      scene.end_time > (last + component.time_step) * nearly) {
    doubts.say(
        "option -end_time {} s: the record along {} ends at {} s, the ground stands "
        "still afterwards",
        {scene.end_time, direction_names[direction], last});
  }
}

/// A motion of which the run leaves out the peak, or more than follows the strong part, which ends
/// at three quarters of the integral of the squared acceleration (Arias intensity).
void add_late_motion(const Scene& scene, const Accelerogram& component, int direction,
                     Doubts doubts) {
  constexpr double whole = 0.99, strong = 0.75;
  double felt = std::abs(component.at(scene.end_time));  // linear between samples, 0 beyond
  double squares = 0, all = 0;
  for (std::size_t i = 0; i < component.acceleration.size(); ++i) {
    const double a = component.acceleration[i];
    all += a * a;
    if (component.start + component.time_step * static_cast<double>(i) > scene.end_time * nearly) {
      continue;
    }
    felt = std::max(felt, std::abs(a));
    squares += a * a;
  }
  if (felt < whole * component.peak()) {
    doubts.say(
        "option -end_time {:.4g} s: the motion along {} has its peak of {:.4g} m/s2 "
        "later; the run feels {:.4g} m/s2 at most",
        {scene.end_time, direction_names[direction], component.peak(), felt});
  } else if (squares < strong * all) {
    doubts.say(
        "option -end_time {:.4g} s: the run ends in the strong part of the motion along {}, after "
        "{:.3g} % of its Arias intensity",
        {scene.end_time, direction_names[direction], 100 * squares / all});
  }
}

/// Between the samples of a direction as they are given: resampling adds nothing to step over.
double given_interval(const Model& model, int direction) {
  for (const MotionDescription& description : model.motion->descriptions()) {
    if (description.direction == direction_names[direction]) return description.time_step;
  }
  return samples(model, direction).time_step;
}

using NodeSet = std::set<std::pair<int, GlobalIndex>>;  // structure and node

NodeSet contact_nodes(const interactions::Interface& interface) {
  NodeSet nodes;
  for (const interactions::Constraint& constraint : interface.constraints) {
    for (const interactions::ConstraintTerm& term : constraint.terms) {
      nodes.emplace(term.structure, term.node);
    }
  }
  return nodes;
}

/// "probe roof: 2 of its 4 nodes are"; "probe roof: its node is".
std::string subject(const ResolvedProbe& probe, std::size_t count) {
  if (probe.nodes.size() == 1) return "probe " + probe.name + ": its node is";
  return sentence("probe {}: {} of its {} nodes are", {probe.name, count, probe.nodes.size()});
}

/// Whether somebody asked for frequencies of spectra.
bool frequencies_are_asked(const Scene& scene) {
  const auto preset = parse_increasing(std::string(option_row("spectra_frequencies").preset.text));
  return scene.spectra.frequencies != preset;
}

/// Spectra beyond half the sampling frequency of the probes, or, where no impacts are looked for,
/// of the motion.
void add_high_spectra(const Scene& scene, const Model& model, Doubts doubts) {
  if (scene.probes.empty()) return;
  const double highest = scene.spectra.frequencies.back();
  const auto add = [&](const std::string& of, double interval, const std::string& what) {
    if (!(highest * 2 * interval > nearly)) return;
    doubts.say(
        "spectra go to {:.4g} Hz (-spectra_frequencies), {} every {:.4g} s tell "
        "nothing above {:.4g} Hz{}",
        {highest, of, interval, 0.5 / interval, what});
  };
  if (scene.output_interval != parse_real(option_row("output_interval").preset.text)) {
    add("samples of the probes", scene.output_interval, "; give a shorter -output_interval");
  }
  if (!scene.contacts.empty() || !frequencies_are_asked(scene)) return;
  double coarsest = 0;
  for (int direction = 0; direction < 3; ++direction) {
    if (samples(model, direction).acceleration.empty()) continue;
    coarsest = std::max(coarsest, given_interval(model, direction));
  }
  add("samples of the motion", coarsest,
      ": beyond, only motion between the samples shows (-resampling)");
}

/// Part of the model's size that a settlement may be.
constexpr double small_settlement = 0.01;

constexpr double small_imbalance = 1e-8;
constexpr double small_residual = 1e-8;

double length_of(const Vector3& v) {
  return std::hypot(v[0], v[1], v[2]);
}

bool is_weightless(const StructureRest& rest) {
  return length_of(rest.weight) == 0 && rest.forces == 0;
}

void doubt_slivers(const LinearSystem& system, Doubts doubts) {
  for (const Sliver& sliver : system.slivers) {
    doubts.add("structure " + system.name,
               "sliver: {} allows by itself {:.4g} s, the median of its group {:.4g} s ({} "
               "such elements in it); mend the mesh",
               {sliver.element, sliver.time_step, sliver.median, sliver.count});
  }
}

void doubt_shifts(const LinearSystem& system, const ModalResult& modal, Doubts doubts) {
  constexpr double highest = 33;  // Hz
  double worst = 0.1;
  if (!system.uniform_damping) return;
  const UniformDamping& uniform = *system.uniform_damping;
  std::string text;
  for (const Mode& mode : modal.modes) {
    if (!mode.location.empty() || !(mode.frequency > 0) || mode.frequency > highest) continue;
    const double moved = uniform.moved(mode.frequency);
    const double shift = moved / mode.frequency - 1;
    if (!(std::abs(shift) > worst)) continue;
    worst = std::abs(shift);
    text = sentence(
        "uniform damping of {:.3g %} moves its mode of {:.3g} Hz by {:.3g %} to {:.3g} Hz, since "
        "modes keep their place at {:.3g} Hz; give -{}_damping_reference where it matters most",
        {uniform.ratio, mode.frequency, shift, moved, uniform.reference, system.name});
  }
  if (!text.empty()) doubts.add("structure " + system.name, "{}", {text});
}

void doubt_mechanisms(const Scene& scene, const Model& model, Doubts doubts) {
  const auto has_no_stiffness = [](const Mode& mode) { return !mode.location.empty(); };
  for (std::size_t s = 0; s < model.buildings.size(); ++s) {
    const std::vector<Mode>& modes = model.buildings[s].modal.modes;
    const auto count = std::ranges::count_if(modes, has_no_stiffness);
    const Connectivity& connectivity = model.buildings[s].findings.connectivity;
    if (count == 0 || !connectivity.wholly_held() || scene.structures[s].allow_loose) continue;
    doubts.add("structure " + scene.structures[s].name,
               "{} of its lowest modes have no stiffness (0 Hz), the first moves most at {}; "
               "look for hinges, missing elements and supports",
               {count, std::ranges::find_if(modes, has_no_stiffness)->location});
  }
}

void doubt_rest(const Model& model, Doubts doubts) {
  if (model.equilibrium && std::ranges::all_of(model.equilibrium->structures, is_weightless)) {
    doubts.say(
        "-preload static, and no structure has a weight or a load at rest: the run starts "
        "undeformed; give -gravity 9.81");
  }
  for (std::size_t s = 0; model.equilibrium && s < model.systems.size(); ++s) {
    const StructureRest& rest = model.equilibrium->structures[s];
    const double settlement = std::max(rest.largest_displacement, length_of(rest.settlement));
    const std::string& name = model.systems[s].name;
    if (settlement > small_settlement * model.interface.model_size) {
      doubts.say(
          "structure {} settles by {} m under its weight and loads: displacements are "
          "taken for small; are its stiffness and its density in SI units?",
          {name, settlement});
    } else if (rest.imbalance > small_imbalance) {
      doubts.add("structure " + name, "the forces that hold it miss its weight by {} of it",
                 {rest.imbalance});
    }
  }
  if (model.equilibrium && model.equilibrium->residual > small_residual) {
    doubts.say(
        "the static equilibrium is found to {} of the weight only, by energy: "
        "round-off of very stiff elements; the run starts as far from rest",
        {model.equilibrium->residual});
  }
}

void doubt_rest_gaps(const Scene& scene, const Model& model, Doubts doubts) {
  for (std::size_t c = 0; model.equilibrium && c < model.joint_gaps.size(); ++c) {
    const JointGaps& gaps = model.joint_gaps[c];
    const double overlap = -gaps.unloaded[0];
    if (!scene.contacts[c].gap_at_rest || !(gaps.at_rest[0] > 0)) continue;
    if (overlap <= none_below * model.interface.model_size) continue;
    const std::string& name = scene.contacts[c].name;
    doubts.add("contact " + name,
               "the weight opens the joint by more than the {:.4g mm} that it has at rest; without "
               "it the faces would overlap by {:.4g mm}; is the gap that of the rest (-{}_gap_at)?",
               {gaps.at_rest[0], overlap, name});
  }
}

}  // namespace

std::vector<std::string> damping_warnings(const Structure& structure, const ModalResult& modal) {
  constexpr double highest = 50;  // Hz
  std::vector<double> frequencies;
  for (const Mode& mode : modal.modes) {
    // The frequency of one near zero is round-off.
    const bool vibrates = mode.location.empty() && !is_wave(structure, mode);
    if (vibrates && (frequencies.empty() || mode.frequency <= highest)) {
      frequencies.push_back(mode.frequency);
    }
  }
  if (frequencies.empty()) frequencies = {1, highest};
  std::vector<std::string> doubts;
  const bool by_mode = structure.modal && !structure.modal->damping_ratios.empty();
  const std::string owner = "structure " + structure.name;
  if (structure.uniform_damping) {
    doubt_uniform(structure, modal.modes, doubts);
  } else if (!by_mode) {
    doubt_rayleigh(owner, structure.damping, frequencies, doubts);
  }
  for (const Region& region : structure.regions) {
    if (by_mode || region.of_water) continue;
    if (!region.damping && region.damping_factor == 1) continue;
    doubt_rayleigh(owner + ", group " + region.group, structure.damping_of(region), frequencies,
                   doubts);
  }
  return doubts;
}

void add_model_doubts(MPI_Comm comm, const Scene& scene, Model& model) {
  const Doubts doubts(model.warnings);
  doubts.add(model.motion->doubts());
  if (model.supports) doubts.add(model.supports->doubts());
  if (model.load_histories) {
    doubts.add(model.load_histories->doubts(scene.loads, model.motion->origin(), scene.end_time));
  }
  for (const LinearSystem& system : model.systems) doubt_slivers(system, doubts);
  doubts.add(model.interface.warnings);
  for (const Building& building : model.buildings) {
    doubts.add(damping_warnings(*building.structure, building.modal));
    doubts.add(wave_doubts(*building.structure, building.beams, building.modal.modes));
    add_mass_doubts(comm, building, doubts);
    add_frequency_doubts(scene, model.probes, building, doubts);
    doubt_shifts(*building.system, building.modal, doubts);
  }
  if (rank_of(comm) == 0) doubt_mechanisms(scene, model, doubts);
  doubt_rest(model, doubts);
  doubt_rest_gaps(scene, model, doubts);
}

void add_long_step(const std::string& of, double sample, double step, Doubts doubts) {
  if (step > sample * nearly) {
    doubts.say("the time step {} s is longer than {}, {} s; give -time_step {} or less",
               {step, of, sample, sample});
  }
}

void add_step_doubts(const Scene& scene, const Model& model, Doubts doubts) {
  if (stands_still(scene) && model.support_columns().empty() && !scene.dry_run &&
      scene.export_matrices.empty()) {
    doubts.say(
        "nothing makes the scene move: no -motion_x_record or -motion_x_target (nor y, z), no "
        "initial displacement or velocity, no gravity");
  }
  for (int direction = 0; direction < 3; ++direction) {
    if (!samples(model, direction).acceleration.empty()) {
      add_short_record(scene, model, direction, doubts);
      add_late_motion(scene, samples(model, direction), direction, doubts);
      add_long_step("a sample of the motion along " + std::string(direction_names[direction]),
                    given_interval(model, direction), model.time_step, doubts);
    }
  }
  doubts.add(long_step_warnings(scene, model));
  add_high_spectra(scene, model, doubts);
  // The interval that nobody asked for is as short as the step where that is longer.
  const auto preset = parse_real(option_row("output_interval").preset.text);
  if (!scene.probes.empty() && scene.output_interval != preset) {
    add_long_step("-output_interval", scene.output_interval, model.time_step, doubts);
  }
}

void add_probe_doubts(std::span<const ResolvedProbe> probes, std::span<const GlobalMesh> meshes,
                      const interactions::Interface& interface, Doubts doubts) {
  constexpr std::uint8_t translations = 7;
  constexpr std::size_t nodes_per_doubt = 4;
  const NodeSet touching = contact_nodes(interface);
  for (const ResolvedProbe& probe : probes) {
    const std::string far =
        snap_doubt("probe " + probe.name, probe.snap_distance, probe.element_size);
    if (!far.empty()) doubts.say("{}", {far});
    const GlobalMesh& mesh = meshes[probe.structure];
    const std::size_t clamped = std::ranges::count_if(probe.nodes, [&](GlobalIndex node) {
      return (mesh.free_components[node] & translations) == 0;
    });
    if (clamped > 0) {
      doubts.say("{} clamped: the {} is recorded there",
                 {subject(probe, clamped),
                  mesh.supported.empty() ? "ground's own motion" : "motion of its support"});
    }
    const std::size_t in_contact = std::ranges::count_if(probe.nodes, [&](GlobalIndex node) {
      return touching.contains({probe.structure, node});
    });
    if (nodes_per_doubt * in_contact >= probe.nodes.size()) {
      doubts.say(
          "{} part of a contact: the accelerations hold the impulses that act on it, and the "
          "samples go with 1/output_interval; for a floor take nodes one element away",
          {subject(probe, in_contact)});
    }
  }
}

}  // namespace pounding
