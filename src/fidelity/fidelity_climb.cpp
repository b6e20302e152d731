#include "fidelity/fidelity_climb.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/facts.h"
#include "fidelity/full_order_window.h"
#include "mesh/kept_inputs.h"

namespace pounding {
namespace {

constexpr int first_modes = 25;

/// Error over target above which the modes grow twice as fast.
constexpr double far_off = 4;

/// Runs that a run with its estimate takes: it, once more, and under the two other motions.
constexpr double runs_of_estimate = 4;

/// Times that a step is cut for the sake of its error.
constexpr int most_cuts = 4;

/// Seconds at full order by which errors are estimated where the scene names none.
constexpr const char* usual_window = "1";

[[noreturn]] void refuse(const std::string& why) {
  throw UserError("option -fidelity_target: " + why);
}

/// Structures whose fidelity is to be chosen.
std::vector<std::string> open_structures(const Scene& scene, const OptionsDatabase& database) {
  std::vector<std::string> open;
  for (const Structure& structure : scene.structures) {
    if (structure.modal) {
      refuse(
          structure.name + " is reduced already; leave -" + structure.name +
          "_model modal and its options out, or the target (-fidelity_window estimates the error)");
    }
    if (!database.contains(structure.name + "_model")) open.push_back(structure.name);
  }
  if (open.empty()) refuse("every structure has a model of its own; leave one -..._model out");
  return open;
}

/// The options of a run; `modes` 0: at full order; `time_step` 0: its own.
OptionsDatabase options_of(OptionsDatabase options, const std::vector<std::string>& structures,
                           int modes, double time_step) {
  options.erase("fidelity_target");
  if (time_step > 0) options["time_step"] = sentence("{:.3g}", {time_step});
  if (modes == 0) {
    options.erase("fidelity_window");
    options.erase("fidelity_mesh");
    return options;
  }
  options.try_emplace("fidelity_window", usual_window);
  for (const std::string& structure : structures) {
    options[structure + "_model"] = "modal";
    options[structure + "_modal_vectors"] = std::to_string(modes);
  }
  return options;
}

ReadScene read_with(const OptionsDatabase& options, const FidelityClimb& climb) {
  ReadScene read = read_scene(options);
  read.scene.fidelity = climb;
  return read;
}

/// Reads the scene with a first reduction; a refusal of it is one of the target.
ReadScene read_reduced(const OptionsDatabase& options, const FidelityClimb& climb) {
  try {
    return read_with(options, climb);
  } catch (const UserError& error) {
    refuse(std::string("the structures cannot be reduced: ") + error.what());
  }
}

/// The error that more modes or a shorter step can bring within the target: that of the mesh counts
/// where it leaves something of it.
double error_of(const FidelityEstimate& estimate, double target) {
  const ErrorPart* mesh = estimate.part("mesh");
  const double own = mesh == nullptr || mesh->rms[0] < target ? 0 : mesh->rms[0];
  return std::sqrt(std::max(0.0, std::pow(estimate.whole(0), 2) - own * own));
}

/// The step whose error is such a share of the target.
double finer_step(const FidelityEstimate& estimate, double target) {
  const double cut = std::ceil(estimate.part("step")->refinement(target));
  return std::min(estimate.run_time_step, estimate.time_step) / std::max(2.0, cut);
}

/// Runs the scene at full order with the scaled mass that an estimate offers, where the user gives
/// none; whether it is within the target. Collective.
bool run_scaled(MPI_Comm comm, const Scene& scene, const OptionsDatabase& database,
                const FidelityEstimate& estimate, double time_step, const SceneOrigin& origin,
                FidelityClimb& climb) {
  OptionsDatabase options = options_of(database, {}, 1, time_step);
  bool any = false;
  for (std::size_t s = 0; s < estimate.scaled_steps.size(); ++s) {
    const Structure& structure = scene.structures[s];
    if (estimate.scaled_steps[s] == 0 || structure.mass_scaling > 0 || structure.p_delta) continue;
    options[structure.name + "_mass_scaling"] = sentence("{:.3g}", {estimate.scaled_steps[s]});
    any = true;
  }
  if (!any) return false;
  FidelityClimb here = climb;
  here.modes = 0;
  here.scaled = true;
  here.reason.clear();
  const RunOutcome outcome =
      run_estimated(comm, read_with(options, here), origin, estimate.part("mesh"));
  const double error = outcome.fidelity ? error_of(*outcome.fidelity, climb.target) : 0;
  climb.tried.push_back({0, error, outcome.wall_time});
  return error <= climb.target;
}

/// Takes the next number of modes, or says why full order is as cheap.
void take_more_modes(const RunOutcome& outcome, double error, FidelityClimb& climb) {
  climb.modes *= error > far_off * climb.target ? 4 : 2;
  if (2 * outcome.wall_time >= outcome.fidelity->full_run_time) {
    climb.reason = sentence("which takes about {:.0f} s, no more than the next reduction would",
                            {outcome.fidelity->full_run_time});
  } else if (2 * static_cast<std::size_t>(climb.modes) >= outcome.dofs) {
    climb.reason = sentence("which has {} dofs, no more than twice the modes", {outcome.dofs});
  }
}

}  // namespace

RunOutcome run_estimated(MPI_Comm comm, ReadScene read, const SceneOrigin& origin,
                         const ErrorPart* mesh) {
  const double window = read.scene.certificate.window;
  if (window == 0) return run_scene(comm, std::move(read), origin);
  if (const std::string why = without_window(read.scene); !why.empty()) {
    throw UserError("option -fidelity_window: no error can be estimated, since " + why +
                    "; leave it out");
  }
  const bool with_mesh = read.scene.certificate.mesh;
  read.scene.kept = std::make_shared<KeptInputs>();
  return run_scene(comm, std::move(read), origin,
                   [=](const Scene& scene, const Model& model, const ImpactCatalogue& impacts,
                       const Recorder& recorder) {
                     return estimate_fidelity(comm, scene, model, impacts, recorder, window,
                                              with_mesh, mesh);
                   });
}

void run_within_target(MPI_Comm comm, const ReadScene& read, const OptionsDatabase& database,
                       const SceneOrigin& origin) {
  if (!read.ensemble.empty()) {
    refuse("not with -ensemble; let a single run find the modes, and give them to the members");
  }
  if (read.scene.probes.empty()) refuse("there is no probe whose spectra could be compared");
  const std::vector<std::string> structures = open_structures(read.scene, database);
  FidelityClimb climb = read.scene.fidelity;
  climb.modes = first_modes;
  bool scaled_tried = false;
  int cuts = 0;
  double time_step = 0;           // 0: its own
  std::optional<ErrorPart> mesh;  // of the first run: it is the same of all
  while (climb.reason.empty()) {
    ReadScene next = read_reduced(options_of(database, structures, climb.modes, time_step), climb);
    if (const std::string why = without_window(next.scene); !why.empty()) {
      refuse("no error can be estimated, since " + why + "; leave it out");
    }
    const RunOutcome outcome =
        run_estimated(comm, std::move(next), origin, mesh ? &*mesh : nullptr);
    if (!outcome.fidelity) return;
    const FidelityEstimate& told = *outcome.fidelity;
    if (!mesh && told.part("mesh") != nullptr) mesh = *told.part("mesh");
    const double error = error_of(told, climb.target);
    if (error <= climb.target) return;
    const bool by_step = told.part("step")->rms[0] > told.rms[0] && cuts < most_cuts;
    climb.tried.push_back({climb.modes, error, outcome.wall_time});
    if (by_step) {
      ++cuts;
      time_step = finer_step(told, climb.target);
      continue;
    }
    take_more_modes(outcome, error, climb);
    const double full = told.full_run_time;
    const double next_cost = climb.reason.empty() ? std::min(2 * outcome.wall_time, full) : full;
    if (scaled_tried || runs_of_estimate * told.scaled_run_time > next_cost) continue;
    scaled_tried = true;
    if (run_scaled(comm, read.scene, database, told, time_step, origin, climb)) return;
  }
  climb.modes = 0;
  run_estimated(comm, read_with(options_of(database, structures, 0, time_step), climb), origin);
}

}  // namespace pounding
