#include "scene/equipment_reader.h"

#include <algorithm>
#include <cmath>

#include "common/types.h"
#include "scene/option_values.h"

namespace pounding {
namespace {

void require_probe(const OptionReader& options, const Scene& scene, const Equipment& item) {
  constexpr std::string_view pattern = "<equipment>_probe";
  const auto probe = std::ranges::find(scene.probes, item.probe, &Probe::name);
  if (probe == scene.probes.end()) {
    options.refuse(pattern, {item.name},
                   "-probes has no such name" + suggestion(item.probe, names_of(scene.probes)));
  }
  options.refuse_if(!probe->average, pattern, {item.name},
                    "it records single nodes: equipment is mounted at one place; not with -" +
                        item.probe + "_average false");
}

void require_rising(const OptionReader& options, std::string_view pattern, const std::string& name,
                    const std::array<double, 2>& band) {
  if (!(band[0] < band[1])) options.refuse(pattern, {name}, "the first is the lower one");
}

}  // namespace

Equipment read_equipment(OptionReader& options, const Scene& scene, const std::string& name) {
  Equipment item;
  item.name = name;
  options.read(item, {name});
  require_probe(options, scene, item);
  const std::string directions = options.choice("<equipment>_direction", {name});
  for (std::size_t d = 0; d < 3; ++d) {
    item.directions[d] = directions == "all" || directions == direction_names[d] ||
                         (directions == "horizontal" && d < 2);
  }
  const bool computed = std::ranges::any_of(scene.spectra.damping_ratios, [&](double ratio) {
    return std::abs(ratio - item.damping) < 1e-9;
  });
  options.refuse_if(!computed, "<equipment>_damping", {name},
                    "there are no floor spectra of this ratio; add it to -spectra_damping");
  require_rising(options, "<equipment>_band", name, item.band);
  require_rising(options, "<equipment>_high_band", name, item.high_band);
  return item;
}

}  // namespace pounding
