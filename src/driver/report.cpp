#include "driver/report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "common/component_names.h"
#include "common/version.h"
#include "driver/contact_report.h"
#include "driver/motion_report.h"
#include "driver/rest.h"
#include "driver/separation.h"
#include "driver/soil_report.h"
#include "driver/storeys.h"
#include "driver/time_step.h"
#include "stability/stable_time_step.h"

namespace pounding {
namespace {

constexpr std::array shown_frequencies{1.0, 10.0, 100.0, 400.0};  // Hz

void print_uniform_damping(const UniformDamping& damping) {
  std::printf("  uniform damping of %.4g %% from %.6g to %.6g Hz", 100 * damping.ratio,
              damping.lowest, damping.highest);
  if (damping.filters.empty()) {
    std::printf(": none\n");
    return;
  }
  std::printf(" within %.2g %% of it, %zu filters; ratio at", 100 * damping.ripple,
              damping.filters.size());
  for (const double frequency : shown_frequencies) {
    std::printf("%s%.0f", frequency == shown_frequencies.front() ? " " : ", ", frequency);
  }
  std::printf(" Hz:");
  for (const double frequency : shown_frequencies) {
    std::printf(" %.3f %%", 100 * damping.ratio_at(2 * std::numbers::pi * frequency));
  }
  std::printf(
      "\n    stiffness: that of the materials at %.6g Hz and under the weight at rest, %.4f of it "
      "for "
      "the slowest motions, %.4f for the fastest\n",
      damping.reference, damping.at_rest(), damping.at_once());
}

void print_damping(const Building& building) {
  const Structure& structure = *building.structure;
  if (building.system->uniform_damping) {
    print_uniform_damping(*building.system->uniform_damping);
    return;
  }
  if (structure.modal && !structure.modal->damping_ratios.empty()) {
    const std::vector<double>& ratios = structure.modal->damping_ratios;
    std::printf(
        "  damping ratio per mode, the last one of all that follow and of vectors that are no "
        "mode:");
    for (const double ratio : ratios) std::printf(" %.3f %%", 100 * ratio);
    std::printf("\n");
    return;
  }
  const auto print_ratios = [](const Rayleigh& damping) {
    for (const double frequency : shown_frequencies) {
      std::printf(" %.3f %%", 100 * damping_ratio(damping, 2 * std::numbers::pi * frequency));
    }
    std::printf("\n");
  };
  std::printf("  damping ratio at 1, 10, 100, 400 Hz:");
  print_ratios(structure.damping);
  for (const Region& region : structure.regions) {
    if (region.damping) {
      std::printf("    of %s:", region.group.c_str());
      print_ratios(*region.damping);
    }
  }
}

void print_reduction(const ModalModel& modal, const ModalBasis& basis, const MassScaling& scaling) {
  const double hertz = 2 * std::numbers::pi;
  std::printf("  modal reduction: %zu generalised coordinates for %lld dofs\n", basis.size(),
              static_cast<long long>(basis.full_dofs));
  std::printf("    %d modes", basis.modes);
  if (modal.cutoff > 0) {
    std::printf(", those below the cut-off of %.6g Hz", modal.cutoff);
  } else if (modal.candidates > modal.modes) {
    std::printf(", chosen among the %d lowest", modal.candidates);
  } else if (modal.modes > basis.modes) {
    std::printf(" (%d asked for, the structure has no more)", modal.modes);
  }
  std::printf("\n    %d attachment vectors%s\n    largest frequency %.4g Hz\n",
              basis.attachment_vectors, modal.attachment ? "" : " (not asked for)",
              std::sqrt(basis.squared_frequency.back()) / hertz);
  if (scaling.time_step > 0) {
    std::printf("    mass scaled for a step of %.4e s: %lld coordinates\n", scaling.time_step,
                static_cast<long long>(scaling.dofs));
  }
}

/// Causes that shorten the step, and what each remedy would give.
void print_remedies(const Building& building) {
  constexpr double worth_a_word = 1.3;
  const LinearSystem& system = *building.system;
  const double omega = building.limits.largest.omega_max;
  const double undamped = 2 / omega;
  const double cost = undamped / building.limits.stable_time_step;
  const auto uniform = uniform_in_place_of(system.damping, building.modal.first_frequency());
  if (cost > worth_a_word && uniform) {
    std::printf(
        "    Rayleigh damping costs %.3g times the steps that there would be without damping; "
        "uniform damping (-%s_damping_uniform %.2g) would cost %.3g\n",
        cost, system.name.c_str(), uniform->ratio, std::sqrt(uniform->at_once()));
  }
  const ScalingOffer& offer = system.scaling_offer;
  const double gain = offer.time_step / building.limits.stable_time_step;
  if (offer.elements > 0 && gain > worth_a_word) {
    constexpr double frequency = 10;  // Hz
    const double beta = system.damping.beta;
    const double factor = offer.time_step / 4 * (2 * beta + system.stiffening() * offer.time_step);
    const double turn = 2 * std::numbers::pi * frequency;
    std::printf(
        "    %lld elements of %s hold the step: -%s_mass_scaling %.2g would allow %.2g times "
        "it, and move no frequency below %.0f Hz by more than %.1g %%\n",
        static_cast<long long>(offer.elements), offer.groups.c_str(), system.name.c_str(),
        offer.time_step, gain, frequency, 50 * factor * turn * turn);
  }
}

/// The scaled mass that reaches the target of the time step, and what it costs.
void print_step_design(const Structure& structure, const StepDesign& design,
                       const RotaryScaling& scaling) {
  const StepTarget& target = *structure.step_target;
  if (design.structure.step_target->shells == 0) {
    std::printf("  time step target %.4e s: %.4e s is stable without scaled mass\n",
                target.time_step, design.before);
    return;
  }
  std::printf("  time step target %.4e s: the stable step grew %.3g times from %.4e s\n",
              target.time_step, design.after / design.before, design.before);
  if (scaling.elements > 0) {
    std::printf(
        "    %lld shells got rotational inertia, at most %.3g times their own about the normal and "
        "%.3g in bending\n",
        static_cast<long long>(scaling.elements), scaling.drilling, scaling.bending);
  }
  std::printf(
      "    no frequency up to %.4g Hz falls by more than %.2g of itself (%.2g is allowed): %.2g by "
      "the rotations of shells alone, %.2g by stiff beams, bars and springs alone\n",
      target.frequency, design.change.largest(), target.change, design.change.by_rotations(),
      design.change.by_elements());
}

/// The bound from single elements behind a limit; nothing where none has a stiffness and a mass.
std::string element_bound(double bound) {
  if (!std::isfinite(bound) || bound == 0) return "";
  char text[64];
  std::snprintf(text, sizeof text, " (bound from single elements %.4e)", bound);
  return text;
}

void print_time_step_limit(const Building& building) {
  const LinearSystem& system = *building.system;
  if (building.design) {
    print_step_design(*building.structure, *building.design, system.rotary_scaling);
  }
  const MassScaling& scaling = system.mass_scaling;
  if (scaling.time_step > 0) {
    std::printf(
        "  mass scaled for a step of %.4e s: %lld elements, %lld coupled dofs, at most %.3e s2 of "
        "their stiffness\n",
        scaling.time_step, static_cast<long long>(scaling.elements),
        static_cast<long long>(scaling.dofs), scaling.largest_factor);
    const bool reached = std::max(building.limits.stable_time_step,
                                  system.element_time_step_bound) >= scaling.time_step;
    if (!reached && !building.design) {
      std::printf(
          "    not reached: %s allows less, its mass is not scaled; the stable step is %.4g "
          "of the wanted one\n",
          system.limiting_element.c_str(), building.limits.stable_time_step / scaling.time_step);
    }
  }
  std::printf("  omega_max %.4e rad/s%s\n", building.limits.largest.omega_max,
              element_bound(system.element_frequency_bound).c_str());
  if (building.limits.largest.excess > 0) {
    std::printf(
        "    a bound after %d products, too large by %.2g %% at most: 1e-10 would take more than "
        "some "
        "seconds (-omega_max_tolerance)\n",
        building.limits.largest.products, 100 * building.limits.largest.excess);
  }
  std::printf("    at %s\n", building.limits.largest.location.c_str());
  if (!system.stiffest_element.empty()) {
    std::printf("    stiffest: %s\n", system.stiffest_element.c_str());
  }
  std::printf(
      "  stable time step %.4e s%s, without damping %.4e s\n", building.limits.stable_time_step,
      element_bound(system.element_time_step_bound).c_str(), 2 / building.limits.largest.omega_max);
  if (!system.limiting_element.empty()) {
    std::printf("    limiting: %s\n", system.limiting_element.c_str());
  }
  print_remedies(building);
  if (!system.extra_damping) {
    std::printf("    damping ratio %.2f at omega_max\n",
                system.uniform_damping
                    ? system.uniform_damping->ratio_at(building.limits.largest.omega_max)
                    : damping_ratio(system.damping, building.limits.largest.omega_max));
  }
}

void print_places(const Places& places, const char* what) {
  if (places.count > 0) {
    std::printf("  %lld %s, the first at (%.6g, %.6g, %.6g)\n",
                static_cast<long long>(places.count), what, places.first[0], places.first[1],
                places.first[2]);
  }
}

/// How the mesh hangs together.
void print_findings(const MeshFindings& findings) {
  const Connectivity& connectivity = findings.connectivity;
  const GlobalIndex loose = connectivity.loose_pieces();
  std::printf("  %zu connected piece%s, ", connectivity.pieces.size(),
              connectivity.pieces.size() == 1 ? "" : "s");
  if (loose == 0) {
    std::printf("held%s\n", connectivity.wholly_held() ? "" : ", not against every rigid motion");
  } else {
    const Vector3& place = connectivity.loose_piece().place;
    std::printf("%lld not held, one at (%.6g, %.6g, %.6g)\n", static_cast<long long>(loose),
                place[0], place[1], place[2]);
  }
  print_places(connectivity.coincident_apart, "pairs of nodes of unjoined pieces coincide");
  print_places(connectivity.ends_inside, "ends of lines lie in elements without a node there");
  print_places(connectivity.hinges,
               "nodes of solids, which hold no rotation, carry beams or shells");
  print_places(connectivity.lone_hinges, "of them carry one beam alone: a hinge");
  std::string unused;
  for (const UnusedElements& elements : findings.unused) {
    unused += (unused.empty() ? "" : ", ") + elements.group;
  }
  if (!unused.empty()) std::printf("  groups without a use: %s\n", unused.c_str());
}

void print_rigid_bodies(const Building& building) {
  constexpr std::array words{"rigid",  "rigid in its plane", "joined",
                             "pinned", "tied by height",     "tied"};
  for (const RigidGroup& rigid : building.structure->rigid_groups) {
    std::printf("  %s: %s", words[static_cast<std::size_t>(rigid.kind)], rigid.name().c_str());
    for (const RigidBodyReport& report : building.system->rigid_bodies) {
      if (report.group != rigid.name()) continue;
      std::printf(", %lld nodes of %.0f kg", static_cast<long long>(report.nodes), report.mass);
      if (report.bodies > 1) std::printf(" in %lld", static_cast<long long>(report.bodies));
      if (rigid.kind == RigidKind::tie) {
        std::printf(", %lld dofs that follow", static_cast<long long>(report.dofs));
        continue;
      }
      std::printf(", %lld dofs by %lld motions", static_cast<long long>(report.dofs),
                  static_cast<long long>(report.motions));
    }
    std::printf("\n");
  }
}

void print_structure(const Building& building) {
  const Mesh& mesh = *building.mesh;
  const LinearSystem& system = *building.system;
  std::printf("\nstructure %s: %lld nodes, %lld dofs (%lld before clamping), mass %.0f kg\n",
              system.name.c_str(), static_cast<long long>(mesh.global_nodes),
              static_cast<long long>(mesh.global_dofs),
              static_cast<long long>(mesh.global_dofs_unclamped), system.total_mass);
  for (const ElementBlock& block : mesh.blocks) {
    std::printf("  %-14s %7lld %s\n", block.group.c_str(),
                static_cast<long long>(block.global_count), element_name(block.type));
  }
  print_rigid_bodies(building);
  print_findings(building.findings);
  std::printf("  stiffness: %s\n", system.stiffness_method.c_str());
  if (building.basis) {
    print_reduction(*building.structure->modal, *building.basis, system.mass_scaling);
  }
  print_damping(building);
  if (building.compression) {
    std::printf("  P-Delta: at rest up to %.6g N press %s\n", building.compression->force,
                building.compression->place.c_str());
  }
  print_soil(*building.structure);
  print_absorbing(*building.structure, building.absorbing);
  print_spread_springs(building.spread);
  if (!building.modal.method.empty()) {
    std::printf("  modes by %s\n", building.modal.method.c_str());
  }
  std::printf("  mode  frequency  direction  effective mass, share of it\n");
  int number = 0;
  for (const Mode& mode : building.modal.modes) {
    const auto way = static_cast<std::size_t>(std::ranges::find(motion_names, mode.direction) -
                                              motion_names.begin());
    const bool turns = way >= 3 && way < motion_names.size();  // no direction: nothing moves
    std::printf("  %4d  %9.3f  %-9s  %8.0f %s %s, %4.1f %% about/along %s", ++number,
                mode.frequency, mode.direction.c_str(),
                way < motion_names.size() ? mode.effective_modal_mass[way] : 0,
                turns ? "kg m2 about" : "kg along", direction_names[way % 3],
                100 * mode.direction_fraction, mode.direction.c_str());
    if (system.uniform_damping) {
      const double moved = system.uniform_damping->moved(mode.frequency);
      std::printf(", damped %.3f Hz (%+.1f %%) at %.3f %%", moved,
                  100 * (moved / mode.frequency - 1),
                  100 * system.uniform_damping->ratio_at(2 * std::numbers::pi * moved));
    }
    std::printf("\n");
  }
  if (building.basis) {
    std::printf("  stable time step %.4e s, exact from the frequencies; it is that of %s\n",
                building.limits.stable_time_step, building.limits.largest.location.c_str());
  } else {
    print_time_step_limit(building);
  }
}

void print_probes(const Recorder& recorder, const StatedPeaks& peaks,
                  const std::vector<ProbeSpectrum>& spectra, double start) {
  if (recorder.channels().empty()) return;
  if (start > 0) {
    std::printf("\npeaks and spectra from %.6g s on, the oscillators at rest then\n", start);
  }
  std::printf(
      "\npeak accelerations below %.4g Hz, and as sampled every %.4g s, where an impulse counts by "
      "1/interval"
      "\nprobe          peak acceleration m/s2   as sampled   peak displacement mm   spectrum peak "
      "m/s2 at Hz\n",
      peaks.frequency, recorder.interval());
  for (std::size_t channel = 0; channel < recorder.channels().size(); ++channel) {
    std::printf("  %-18s %14.3f %15.3f %17.3f", recorder.channels()[channel].c_str(),
                peaks.acceleration[channel], recorder.peaks()[channel].acceleration,
                1000 * recorder.peaks()[channel].displacement);
    const std::string& probe = recorder.probes()[channel / 3].name;
    for (const ProbeSpectrum& spectrum : spectra) {
      if (spectrum.probe == probe && spectrum.direction == direction_names[channel % 3]) {
        const auto peak = std::max_element(spectrum.points.begin(), spectrum.points.end(),
                                           [](const auto& a, const auto& b) {
                                             return a.pseudo_acceleration < b.pseudo_acceleration;
                                           });
        std::printf(" %14.2f at %.4g (%g %%)", peak->pseudo_acceleration, peak->frequency,
                    100 * spectrum.damping_ratio);
      }
    }
    std::printf("\n");
  }
}

/// Where each probe sits, and how far that is from the place asked for.
void print_probe_places(const Scene& scene, const std::vector<ResolvedProbe>& probes) {
  constexpr std::size_t shown = 20;
  std::printf("%s", probes.empty() ? "" : "\n");
  for (std::size_t p = 0; p < std::min(shown, probes.size()); ++p) {
    const ResolvedProbe& probe = probes[p];
    std::printf(
        "probe %s: %zu node%s of %s at (%.6g, %.6g, %.6g), at most %.3g mm from what was asked\n",
        probe.name.c_str(), probe.nodes.size(), probe.nodes.size() == 1 ? "" : "s",
        scene.structures[probe.structure].name.c_str(), probe.position[0], probe.position[1],
        probe.position[2], 1000 * probe.snap_distance);
  }
  if (probes.size() > shown) std::printf("  ... and %zu more probes\n", probes.size() - shown);
}

}  // namespace

void print_partition(const Model& model) {
  std::printf("\npartition: imbalance %.3f, cut edges %ld\n", model.partition_imbalance,
              model.partition_edge_cut);
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) std::printf("warning: %s\n", warning.c_str());
}

void print_title(const Scene& scene, const std::string& overrides, int ranks) {
  int major = 0;
  int minor = 0;
  int subminor = 0;
  PetscGetVersionNumber(&major, &minor, &subminor, nullptr);
  std::printf("pounding %s (%s), PETSc %d.%d.%d, %d rank%s\n", program_version(), program_commit(),
              major, minor, subminor, ranks, ranks == 1 ? "" : "s");
  if (!scene.title.empty()) std::printf("%s\n", scene.title.c_str());
  if (!overrides.empty()) std::printf("  %s\n", overrides.c_str());
  if (!scene.fidelity_note.empty()) std::printf("%s\n", scene.fidelity_note.c_str());
  print_warnings(scene.warnings);
}

void print_model(const Scene& scene, const Model& model) {
  print_motion(*model.motion, model.supports.get());
  for (const Building& building : model.buildings) print_structure(building);
  for (std::size_t c = 0; c < model.interface.reports.size(); ++c) {
    print_contact(scene.contacts[c], model.interface.reports[c],
                  model.equilibrium ? &model.joint_gaps[c] : nullptr);
  }
  print_separations(scene, model.separations);
  print_rest(scene, model);
  print_probe_places(scene, model.probes);
  print_partition(model);
  print_warnings(model.warnings);
}

void print_time_step(const Scene& scene, const Model& model, double seconds_per_step) {
  if (std::isfinite(model.filler_time_step)) {
    std::printf("fillers allow a time step of %.4e s\n", model.filler_time_step);
  }
  std::printf("time step %.6g s (%.3f of the stable one), %lld steps to %.6g s\n", model.time_step,
              model.time_step / model.smallest_stable_time_step(),
              static_cast<long long>(model.steps), scene.end_time);
  std::printf("  %s\n", step_source_text(scene, model).c_str());
  if (model.step_source == StepSource::resolution) {
    std::printf("  earlier versions took %.6g s: see What changes your numbers in CHANGELOG.md\n",
                earlier_time_step(scene, model));
  }
  if (seconds_per_step > 0) {
    std::printf("expected wall time of the steps: %.1f s (%.1f microseconds per step, measured)\n",
                seconds_per_step * static_cast<double>(model.steps), 1e6 * seconds_per_step);
  }
  std::fflush(stdout);
}

void print_removed(const Scene& scene, std::span<const std::string> files) {
  std::printf("removed from %s, left by an earlier run:", scene.output.c_str());
  for (const std::string& file : files) std::printf(" %s", file.c_str());
  std::printf("\n");
}

void print_restart(const Scene& scene, const Model& model, std::int64_t step) {
  std::printf("continuing %s after step %lld, t = %.6g s\n", scene.restart.c_str(),
              static_cast<long long>(step), static_cast<double>(step) * model.time_step);
  std::fflush(stdout);
}

void print_results(const Scene& scene, const RunStatistics& statistics,
                   const ImpactCatalogue& impacts, const Recorder& recorder,
                   const std::vector<ProbeSpectrum>& spectra) {
  std::printf("\n");
  print_impacts(scene, statistics, impacts);
  print_fillers(scene, statistics);
  print_closings(scene, statistics);
  print_slides(scene, statistics);
  print_loops(statistics);
  print_contact_ratios(scene, statistics);
  print_forces(statistics.forces);
  print_drifts(recorder.drifts());
  print_probes(recorder, statistics.peaks, spectra, scene.spectra.start);
  std::printf("\n");
  print_warnings(statistics.warnings);
  const EnergyLine& energy = statistics.energy;
  std::printf(
      "\nenergy at the end [J]: kinetic %.4g, strain %.4g, damping loss %.4g, contact work %.4g, "
      "input work %.4g\n",
      energy.kinetic, energy.strain, energy.damping_loss, energy.contact_work, energy.input_work);
  if (energy.friction_loss != 0) {
    std::printf("  friction of contacts took %.4g\n", energy.friction_loss);
  }
  if (energy.gravity_work != 0) {
    std::printf("  of the input work that of gravity %.4g\n", energy.gravity_work);
  }
  if (std::abs(energy.device_work) > 1e-12 * std::abs(energy.energy())) {
    std::printf(
        "  device work %.4g: of dashpots, one-way bars and springs, and what regions with damping "
        "of "
        "their own\n  lose beside the damping of their structure\n",
        energy.device_work);
  }
  std::printf("  largest residual of the energy identity: %.2e of the largest term\n",
              statistics.energy_residual);
  std::printf("\nwall time %.2f s, %.3f microseconds per step\n", statistics.wall_time,
              1e6 * statistics.step_time /
                  static_cast<double>(std::max<std::int64_t>(1, statistics.steps)));
  print_phases(statistics.phases);
  std::printf("results in %s\n", scene.output.c_str());
}

}  // namespace pounding
