#include "driver/region_report.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "elements/element_traits.h"
#include "scene/spread_words.h"

namespace pounding {
namespace {

using Json = nlohmann::ordered_json;

Json describe_material(const Material& material) {
  return {{"name", material.name},
          {"young", material.young},
          {"poisson", material.poisson},
          {"density", material.density}};
}

Json describe_section(const Section& section) {
  return {{"name", section.name},           {"area", section.area},
          {"inertia_y", section.inertia_y}, {"inertia_z", section.inertia_z},
          {"torsion", section.torsion},     {"z_axis", section.z_axis}};
}

void add_number(const char* name, double value, Json& description) {
  if (value != 0) description[name] = value;
}

template <typename Values>
void add_numbers(const char* name, const Values& values, Json& description) {
  const bool any = std::ranges::any_of(values, [](double value) { return value != 0; });
  if (any) description[name] = values;
}

}  // namespace

Json describe_regions(const Structure& structure) {
  Json regions = Json::object();
  for (const Region& region : structure.regions) {
    Json& of = regions[region.group];
    of["element"] = element_name(region.element);
    if (region.material.young > 0) of["material"] = describe_material(region.material);
    if (region.section) of["section"] = describe_section(*region.section);
    add_number("area", region.area, of);
    add_number("thickness", region.thickness, of);
    add_number("added_mass", region.added_mass, of);
    add_number("mass", region.mass, of);
    add_numbers("rotary_inertia", region.rotary_inertia, of);
    const std::string per = per_extent(region.spread);
    add_numbers(("stiffness" + per).c_str(), region.stiffness, of);
    add_numbers(("dashpot" + per).c_str(), region.dashpot, of);
    add_numbers("yield_force", region.nonlinear.yield_force, of);
    add_number("sliding_friction", region.nonlinear.friction, of);
    if (is_one_way(region)) of["one_way"] = true;
  }
  return regions;
}

}  // namespace pounding
