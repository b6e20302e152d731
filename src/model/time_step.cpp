#include "model/time_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "common/error.h"
#include "common/facts.h"
#include "common/parallel.h"
#include "interactions/filler_rows.h"
#include "interactions/soil_rows.h"
#include "modal/reduced_system.h"
#include "stability/stable_time_step.h"
#include "system/links.h"

namespace pounding {
namespace {

constexpr double noticeable = 1 + 1e-9;
constexpr double turn = 2 * std::numbers::pi;

bool has_reduced(const Scene& scene) {
  return std::ranges::any_of(
      scene.structures, [](const Structure& structure) { return structure.modal.has_value(); });
}

/// The shortest step that stability, resolution and, of reduced structures, the samples allow.
void choose_automatically(const Scene& scene, const StepLimits& limits, Model& model) {
  model.time_step = round_down(scene.courant * limits.stable);
  model.step_source = StepSource::stability;
  const double accurate = limits.resolved.accurate_step();
  if (std::isfinite(accurate) && round_down(accurate) < model.time_step) {
    model.time_step = round_down(accurate);
    model.step_source = StepSource::resolution;
  }
  if (has_reduced(scene) && scene.output_interval < model.time_step) {
    model.time_step = scene.output_interval;
    model.step_source = StepSource::samples;
  }
}

/// Dashpots in series with springs make vibrations that modes, which leave them out, do not show.
bool hides_vibrations(const Structure& structure) {
  return std::ranges::any_of(structure.regions, has_series);
}

/// Upper bound of the part that those springs have in omega^2 while their dashpots hold: largest
/// sum of a row of M^-1 sum k b b^T [1/s2]. Collective.
double added_by_series(const LinearSystem& system, MPI_Comm comm) {
  std::vector<double> sums(system.lumped_mass.size(), 0.0);
  std::vector<double> field = sums;
  for (const Link& link : system.links->links()) {
    const interactions::LinkOrigin& origin = link.origin;
    if (origin.region == nullptr || origin.part != interactions::SpringPart::dashpot) continue;
    const auto component = static_cast<std::size_t>(origin.component);
    const double k = origin.share * origin.region->nonlinear.dashpot_stiffness[component];
    const Trace& trace = system.links->trace();
    for (std::size_t i = 0; i < link.point.size(); ++i) {
      if (link.point[i] < 0) continue;
      trace.add_force(static_cast<std::size_t>(link.point[i]), link.weight[i], field);
    }
    double whole = 0;
    for (const LocalIndex dof : trace.dofs()) whole += std::abs(field[dof]);
    for (const LocalIndex dof : trace.dofs()) {
      sums[dof] += k * whole * std::abs(std::exchange(field[dof], 0));
    }
  }
  double most = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (sums[i] > 0) most = std::max(most, sums[i] / system.lumped_mass[i]);
  }
  reduce_over_ranks(comm, MPI_MAX, most);
  return most;
}

/// "2 Hz, the highest mode of a up to 400 Hz".
std::string frequency_text(const Scene& scene, const ResolvedMotion& resolved) {
  if (!resolved.load.empty()) {
    return sentence("{:.4g} Hz, the fastest part of load {}",
                    {resolved.frequency(), resolved.load});
  }
  const std::string which = resolved.is_mode
                                ? sentence("highest mode of {} up to {:.4g} Hz",
                                           {resolved.structure, scene.spectra.frequencies.back()})
                                : "last of -spectra_frequencies";
  return sentence("{:.4g} Hz, the {}", {resolved.frequency(), which});
}

constexpr int halvings = 200;

/// mu_s of a structure.
double margin_of(const Building& building, double time_step) {
  if (building.system->has_extra_damping()) {
    return 1 - time_step / building.limits.stable_time_step;
  }
  return energy_margin_of(*building.structure, *building.system, *building.mesh,
                          building.basis_or_null(), building.limits, time_step, {});
}

/// Whether the fillers leave the step stable.
bool is_stable(const Model& model, const std::vector<double>& eta, double time_step) {
  double sum = 0;
  for (std::size_t s = 0; s < eta.size(); ++s) {
    if (eta[s] == 0) continue;
    const double margin = margin_of(model.buildings[s], time_step);
    if (!(margin > 0)) return false;
    sum += time_step * time_step / 4 * eta[s] / margin;
  }
  return sum <= 1;
}

/// Whether a row is the one before it the other way round, of a stop that stops both ways: only one
/// of the two presses at a time.
bool acts_back(const std::vector<interactions::Constraint>& rows, std::size_t row) {
  if (row == 0 || !rows[row].filler.is_spring() || rows[row - 1].contact != rows[row].contact) {
    return false;
  }
  return std::ranges::equal(rows[row].terms, rows[row - 1].terms, [](const auto& a, const auto& b) {
    return a.structure == b.structure && a.node == b.node && a.component == b.component &&
           a.coefficient == -b.coefficient;
  });
}

}  // namespace

ResolvedMotion resolved_motion_of(const Structure& structure, const ModalBasis& basis,
                                  double last) {
  const std::vector<double> masses = coordinate_masses(structure, basis);
  std::vector<double> frequencies;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    frequencies.push_back(std::sqrt(basis.squared_frequency[i] / masses[i]) / turn);
  }
  const bool all = !hides_vibrations(structure);
  ResolvedMotion resolved =
      resolved_motion(frequencies, all, largest_frequency(structure, basis).omega_max, last);
  if (!all) resolved = {turn * last, false, {}};
  resolved.structure = structure.name;
  return resolved;
}

ResolvedMotion resolved_motion_of(const Building& building, double last) {
  if (building.basis) return resolved_motion_of(*building.structure, *building.basis, last);
  std::vector<double> frequencies;
  for (const Mode& mode : building.modal.modes) frequencies.push_back(mode.frequency);
  const bool all = static_cast<GlobalIndex>(frequencies.size()) >= building.mesh->global_dofs;
  ResolvedMotion resolved =
      resolved_motion(frequencies, all, building.limits.largest.omega_max, last);
  if (hides_vibrations(*building.structure)) {
    const double fastest =
        std::hypot(building.limits.largest.omega_max,
                   std::sqrt(added_by_series(*building.system, building.mesh->comm)));
    resolved = all ? ResolvedMotion{fastest, true, {}} : resolved_motion({}, false, fastest, last);
  }
  resolved.structure = building.structure->name;
  return resolved;
}

StepLimits step_limits(const Scene& scene, const Model& model) {
  const double last = scene.spectra.frequencies.back();
  StepLimits limits{model.smallest_stable_time_step(), {}};
  for (const Building& building : model.buildings) {
    limits.resolved = faster(limits.resolved, resolved_motion_of(building, last));
  }
  limit_by_fillers(model.filler_time_step, last, limits);
  limit_by_loads(scene, model.load_histories.get(), limits);
  return limits;
}

void limit_by_loads(const Scene& scene, const LoadHistories* histories, StepLimits& limits) {
  for (std::size_t l = 0; l < scene.loads.size(); ++l) {
    const double fastest = histories->fastest(l, scene.end_time, !scene.preload);
    limits.resolved = faster(limits.resolved, {turn * fastest, false, {}, scene.loads[l].name});
  }
}

void limit_by_fillers(double stable, double last, StepLimits& limits) {
  ResolvedMotion fillers = resolved_motion({}, false, 2 / stable, last);
  fillers.structure = "the fillers, stops and soil between mats";
  limits.stable = std::min(limits.stable, stable);
  limits.resolved = faster(limits.resolved, fillers);
}

void choose_time_step(const Scene& scene, const StepLimits& limits, Model& model) {
  model.step_limits = limits;
  if (scene.time_step > 0) {
    model.time_step = scene.time_step;
    model.step_source = StepSource::given;
  } else if (std::isfinite(limits.stable)) {
    choose_automatically(scene, limits, model);
  } else {
    throw UserError(
        "nothing in the scene vibrates, so nothing limits the time step: give -time_step");
  }
  if (model.time_step > limits.stable && !scene.allow_unstable) {
    throw UserError(
        sentence("option -time_step {} s: above the stable time step {} s; give a smaller one (or "
                 "leave it out), or -allow_unstable for a study",
                 {model.time_step, limits.stable}));
  }
  constexpr double most_steps = 1e12;
  refuse_if(scene.end_time / model.time_step > most_steps,
            sentence("option -end_time {} s: {} steps of {} s, above {}; give a shorter time{}",
                     {scene.end_time, scene.end_time / model.time_step, model.time_step, most_steps,
                      (scene.time_step > 0 ? ", or a longer -time_step" : "")}));
  model.steps = static_cast<std::int64_t>(std::ceil(scene.end_time / model.time_step - 1e-9));
}

std::string step_source_text(const Scene& scene, const Model& model) {
  switch (model.step_source) {
    case StepSource::stability:
      return sentence("set by the stable one, -courant {}", {scene.courant});
    case StepSource::resolution:
      return "set by the motion that it resolves within 0.3 %: " +
             frequency_text(scene, model.step_limits.resolved);
    case StepSource::samples:
      return "set by -output_interval, since a structure is reduced";
    default:
      return "as -time_step gives it";
  }
}

double earlier_time_step(const Scene& scene, const Model& model) {
  const double stable = round_down(scene.courant * model.step_limits.stable);
  return has_reduced(scene) ? std::min(stable, scene.output_interval) : stable;
}

std::vector<std::string> long_step_warnings(const Scene& scene, const Model& model) {
  const ResolvedMotion& resolved = model.step_limits.resolved;
  const double accurate = round_down(resolved.accurate_step());
  if (!(scene.time_step > accurate * noticeable)) return {};
  return {sentence(
      "the time step {:.3g} s makes {}, {:.3g} % too high, and none up to {:.3g} Hz by more "
      "than 0.3 %; give -time_step {:.3g} or less, or leave it out{}",
      {scene.time_step, frequency_text(scene, resolved), 100 * resolved.error(scene.time_step),
       resolved_frequency(scene.time_step), accurate,
       resolved.load.empty() ? ", or end -spectra_frequencies there" : ""})};
}

double filler_limit(MPI_Comm comm, const Scene& scene, const Model& model,
                    std::span<const Mesh> meshes) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!interactions::has_fillers(model.interface) && model.interface.soil.empty()) return infinity;
  const interactions::FillerPairs pairs(comm, model.interface, model.systems, meshes);
  const interactions::CoupledRows soil =
      interactions::make_soil_rows(comm, model.interface, model.systems, meshes);
  std::vector<double> soil_stiffness;
  for (const interactions::SoilRow& row : model.interface.soil) {
    soil_stiffness.push_back(std::max(0.0, row.impedance.stiffness));
  }
  std::vector<double> stiffness;
  for (const interactions::FillerPairs::Pair& row : pairs.all()) {
    const Contact& contact = scene.contacts[row.contact];
    if (acts_back(model.interface.constraints, row.row)) {
      stiffness.push_back(0);
    } else if (contact.is_elastic()) {
      stiffness.push_back(contact.stop->stiffness);
    } else {
      stiffness.push_back(contact.filler->stiffness(row.part.thickness, row.part.area));
    }
  }
  std::vector<double> eta;
  double together = 0;
  double low = infinity;
  for (std::size_t s = 0; s < model.buildings.size(); ++s) {
    eta.push_back(pairs.largest_eigenvalue(s, stiffness) +
                  soil.largest_eigenvalue(s, soil_stiffness));
    together += eta.back();
    if (eta.back() > 0) low = std::min(low, model.buildings[s].limits.stable_time_step);
  }
  if (!(together > 0)) return infinity;
  double high = std::min(low, 2 / std::sqrt(together));  // no margin is above 1
  if (is_stable(model, eta, high)) return high;
  low = 0;
  for (int i = 0; i < halvings && high - low > 1e-12 * high; ++i) {
    const double middle = (low + high) / 2;
    (is_stable(model, eta, middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace pounding
