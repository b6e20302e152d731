#include "scene/clamp_reader.h"

#include <algorithm>

#include "common/component_names.h"
#include "scene/option_values.h"

namespace pounding {
std::vector<Clamp> read_clamps(OptionReader& options, const std::string& structure) {
  constexpr std::string_view pattern = "<structure>_clamp";
  std::vector<Clamp> clamps;
  for (const std::string& item : options.list(pattern, {structure})) {
    const std::vector<std::string> sides = split(item, ':');
    if (sides.size() > 2 || sides[0].empty()) {
      options.refuse(pattern, {structure}, "'" + item + "' is not group or group:components");
    }
    Clamp clamp{sides[0]};
    if (std::ranges::count(clamps, clamp.group, &Clamp::group) > 0) {
      options.refuse(pattern, {structure}, "group '" + clamp.group + "' is listed twice");
    }
    if (sides.size() == 2) {
      clamp.components = 0;
      for (const std::string& name : split(sides[1], '+')) {
        const auto found = std::ranges::find(motion_names, name);
        if (found == motion_names.end()) {
          options.refuse(pattern, {structure},
                         "'" + item + "': '" + name + "' is no component of x, y, z, rx, ry, rz");
        }
        clamp.components |= static_cast<std::uint8_t>(1u << (found - motion_names.begin()));
      }
    }
    clamps.push_back(clamp);
  }
  return clamps;
}

}  // namespace pounding
