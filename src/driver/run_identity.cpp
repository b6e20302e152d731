#include "driver/run_identity.h"

#include "common/hash.h"
#include "scene/option_table.h"
#include "scene/resolved_options.h"

namespace pounding {
namespace {

std::string hash_of(const GroundMotion& motion, const SupportMotion* supports) {
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
  return hash.text();
}

}  // namespace

std::map<std::string, std::string> lasting_options(const std::string& resolved) {
  std::map<std::string, std::string> options;
  for (const auto& [name, value] : resolved_values(resolved)) {
    if (!may_change_on_restart(name)) options[name] = value;
  }
  return options;
}

RunIdentity identity_of(const std::string& resolved, const Model& model) {
  return {lasting_options(resolved), model.time_step, hash_of(*model.motion, model.supports.get())};
}

}  // namespace pounding
