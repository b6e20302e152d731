#include "fidelity/fidelity_climb.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "common/error.h"
#include "driver/facts.h"
#include "fidelity/full_order_window.h"

namespace pounding {
namespace {

constexpr int first_modes = 25;

/// Error over target above which the modes grow twice as fast.
constexpr double far_off = 4;

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

/// The options of a run; `modes` 0: at full order.
OptionsDatabase options_of(OptionsDatabase options, const std::vector<std::string>& structures,
                           int modes) {
  options.erase("fidelity_target");
  if (modes == 0) {
    options.erase("fidelity_window");
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

}  // namespace

RunOutcome run_estimated(MPI_Comm comm, ReadScene read, const SceneOrigin& origin) {
  const double window = read.scene.fidelity_window;
  if (window == 0) return run_scene(comm, std::move(read), origin);
  if (const std::string why = without_window(read.scene); !why.empty()) {
    throw UserError("option -fidelity_window: no error can be estimated, since " + why +
                    "; leave it out");
  }
  return run_scene(comm, std::move(read), origin,
                   [=](const Scene& scene, const Model& model, const ImpactCatalogue& impacts,
                       const Recorder& recorder) {
                     return estimate_fidelity(comm, scene, model, impacts, recorder, window);
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
  while (climb.reason.empty()) {
    ReadScene next = read_reduced(options_of(database, structures, climb.modes), climb);
    if (const std::string why = without_window(next.scene); !why.empty()) {
      refuse("no error can be estimated, since " + why + "; leave it out");
    }
    const RunOutcome outcome = run_estimated(comm, std::move(next), origin);
    if (!outcome.fidelity || outcome.fidelity->rms[0] <= climb.target) return;
    const double error = outcome.fidelity->rms[0];
    climb.tried.push_back({climb.modes, error, outcome.wall_time});
    climb.modes *= error > far_off * climb.target ? 4 : 2;
    if (2 * outcome.wall_time >= outcome.fidelity->full_run_time) {
      climb.reason = sentence("which takes about {:.0f} s, no more than the next reduction would",
                              {outcome.fidelity->full_run_time});
    } else if (2 * static_cast<std::size_t>(climb.modes) >= outcome.dofs) {
      climb.reason = sentence("which has {} dofs, no more than twice the modes", {outcome.dofs});
    }
  }
  climb.modes = 0;
  run_estimated(comm, read_with(options_of(database, structures, 0), climb), origin);
}

}  // namespace pounding
