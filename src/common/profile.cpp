#include "common/profile.h"

namespace pounding {

const char* phase_name(Phase phase) {
  static constexpr std::array<const char*, static_cast<std::size_t>(Phase::count)> names{
      "mesh", "partition", "assembly", "modes", "step", "contact", "energy", "output"};
  return names[static_cast<std::size_t>(phase)];
}

}  // namespace pounding
