#include "scene/equipment_reader.h"

#include <algorithm>
#include <cmath>

#include "common/types.h"
#include "scene/option_values.h"

namespace pounding {
namespace {

void read_probe_of(OptionReader& options, const Scene& scene, Equipment& item) {
  constexpr std::string_view pattern = "<equipment>_probe";
  item.probe = options.text(pattern, {item.name});
  const auto probe = std::ranges::find(scene.probes, item.probe, &Probe::name);
  if (probe == scene.probes.end()) {
    std::vector<std::string> names;
    for (const Probe& one : scene.probes) names.push_back(one.name);
    options.refuse(pattern, {item.name},
                   "-probes has no such name" + suggestion(item.probe, names));
  }
  if (!probe->average) {
    options.refuse(pattern, {item.name},
                   "it records single nodes: equipment is mounted at one place; not with -" +
                       item.probe + "_average false");
  }
}

std::array<double, 2> read_band(OptionReader& options, std::string_view pattern,
                                const std::string& name) {
  const std::vector<double> ends = options.reals(pattern, {name}, 2);
  if (!(ends[0] < ends[1])) options.refuse(pattern, {name}, "the first is the lower one");
  return {ends[0], ends[1]};
}

}  // namespace

Equipment read_equipment(OptionReader& options, const Scene& scene, const std::string& name) {
  Equipment item;
  item.name = name;
  read_probe_of(options, scene, item);
  const std::string directions = options.choice("<equipment>_direction", {name});
  for (std::size_t d = 0; d < 3; ++d) {
    item.directions[d] = directions == "all" || directions == direction_names[d] ||
                         (directions == "horizontal" && d < 2);
  }
  item.capacity_file = options.text("<equipment>_capacity", {name});
  item.capacity_in_g = options.choice("<equipment>_capacity_unit", {name}) == "g";
  item.damping = options.real("<equipment>_damping", {name});
  const bool computed = std::ranges::any_of(scene.spectra.damping_ratios, [&](double ratio) {
    return std::abs(ratio - item.damping) < 1e-9;
  });
  if (!computed) {
    options.refuse("<equipment>_damping", {name},
                   "there are no floor spectra of this ratio; add it to -spectra_damping");
  }
  item.margin = options.real("<equipment>_margin", {name});
  item.broadening = options.real("<equipment>_broadening", {name});
  if (options.given("<equipment>_band", {name})) {
    item.band = read_band(options, "<equipment>_band", name);
  }
  item.high_band = read_band(options, "<equipment>_high_band", name);
  item.dip = options.real("<equipment>_dip", {name});
  if (options.given("<equipment>_cabinet_frequency", {name})) {
    item.cabinet_frequency = options.real("<equipment>_cabinet_frequency", {name});
    item.cabinet_damping = options.real("<equipment>_cabinet_damping", {name});
  }
  return item;
}

}  // namespace pounding
