#include "driver/run_identity.h"

#include <algorithm>
#include <numbers>

#include "common/hash.h"
#include "common/parallel.h"
#include "io/file_digest.h"
#include "scene/option_table.h"
#include "scene/resolved_options.h"
#include "system/matrix_system.h"

namespace pounding {
namespace {

std::string hash_of(const GroundMotion& motion, const SupportMotion* supports,
                    const LoadHistories* loads) {
  Hash hash;
  for (int direction = 0; direction < 3; ++direction) {
    const Accelerogram& component = motion.component(direction);
    hash.add(component.time_step);
    hash.add(component.start);
    hash.add_all(component.acceleration);
    const Accelerogram& incident = motion.incident(direction);
    if (!incident.acceleration.empty()) {
      hash.add(incident.time_step);
      hash.add(incident.start);
      hash.add_all(incident.acceleration);
    }
  }
  for (std::size_t c = 0; supports != nullptr && c < supports->columns().size(); ++c) {
    hash.add(supports->own(c).time_step);
    hash.add(supports->own(c).start);
    hash.add_all(supports->own(c).acceleration);
  }
  for (std::size_t l = 0; loads != nullptr && l < loads->size(); ++l) {
    hash.add_all(loads->function(l).times);
    hash.add_all(loads->function(l).values);
  }
  return hash.text();
}

/// Contents of the files of an option, as options of their own.
void add_matrices(const std::string& option, const std::string& folder,
                  std::map<std::string, std::string>& options) {
  for (const char* matrix : {"stiffness", "mass", "damping"}) {
    const std::string path = matrix_file(folder, matrix);
    if (!path.empty()) options[option + " (its " + matrix + ")"] = digest_of_file(path).sha256;
  }
}

}  // namespace

std::map<std::string, std::string> lasting_options(MPI_Comm comm, const std::string& resolved) {
  std::map<std::string, std::string> options;
  for (const auto& [name, value] : resolved_values(resolved)) {
    if (!may_differ(name, Comparison::restart)) options[name] = value;
  }
  on_rank0(comm, [&] {
    const std::map<std::string, std::string> named = options;
    for (const auto& [name, folder] : named) {
      if (name.ends_with("_matrices") && folder != "none") add_matrices(name, folder, options);
      if (name.ends_with("_soil_table") && folder != "none") {
        options[name + " (its content)"] = digest_of_file(folder).sha256;
      }
    }
  });
  return options;
}

RunIdentity identity_of(MPI_Comm comm, const std::string& resolved, const Model& model) {
  RunIdentity identity{lasting_options(comm, resolved), model.time_step,
                       hash_of(*model.motion, model.supports.get(), model.load_histories.get())};
  for (const Building& building : model.buildings) {
    if (!follows_spectra(*building.structure, building.beams)) continue;
    for (const Region& region : building.structure->regions) {
      identity.beam_frequency =
          std::max(identity.beam_frequency, region.resolved_frequency / (2 * std::numbers::pi));
    }
  }
  return identity;
}

}  // namespace pounding
