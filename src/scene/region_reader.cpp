#include "scene/region_reader.h"

#include <algorithm>
#include <cmath>

#include "scene/damping_reader.h"
#include "scene/hysteresis_reader.h"
#include "scene/option_blocks.h"
#include "scene/option_values.h"
#include "scene/spring_reader.h"
#include "scene/standard_parts.h"
#include "scene/stiffness_factor.h"

namespace pounding {
namespace {

using Names = OptionReader::Names;

/// Options that belong to some elements only: refused beside the others.
void forbid_others(const OptionReader& options, const std::string& element, const Names& names) {
  const ElementFamily family = traits_of(element_of_word(element)).family;
  for (const OptionRow& row : option_table()) {
    if (row.block == OptionBlock::region && !row.is_for(family)) {
      options.forbid(row.pattern, names,
                     "not for the element " + element + " of this group; leave it out");
    }
  }
}

/// Refuses the reference of a region to a material or section that has no option at all, or only
/// some of them while its name is a slip of that of a standard one. `first`: an option that every
/// one has.
void require_defined(const OptionReader& options, std::string_view pattern, const Names& region,
                     std::string_view first, const std::string& name) {
  if (options.given(first, {name})) return;
  const OptionBlock block = option_row(first).block;
  const bool some = std::ranges::any_of(option_table(), [&](const OptionRow& row) {
    return row.block == block && options.given(row.pattern, {name});
  });
  std::string near = block == OptionBlock::section ? standard_section_suggestion(name)
                                                   : standard_material_suggestion(name);
  if (some && near.empty()) return;  // the option that is missing says more
  const std::string own = suggestion(name, complete_names(options.database(), block));
  if (!own.empty()) near = own;
  options.refuse(pattern, region,
                 "'" + name + "' is neither " + (some ? "wholly " : "") +
                     "defined nor the name of a standard one" + near);
}

Material read_material(OptionReader& options, const Names& region) {
  const std::string_view pattern = "<structure>_<group>_material";
  const std::string name = options.text(pattern, region);
  require_defined(options, pattern, region, "material_<material>_young", name);
  Material material;
  material.name = name;
  options.read(material, {name});
  return material;
}

/// Solids and shells have no mass but that of their material.
void require_density(const OptionReader& options, const Region& region) {
  const ElementFamily family = traits_of(region.element).family;
  if (region.material.density > 0 ||
      (family != ElementFamily::solid && family != ElementFamily::shell)) {
    return;
  }
  options.refuse("material_<material>_density", {region.material.name},
                 "group " + region.group + " is of solids or shells, which need one above 0");
}

Section read_section(OptionReader& options, const Names& region) {
  const std::string_view pattern = "<structure>_<group>_section";
  Section section;
  section.name = options.text(pattern, region);
  require_defined(options, pattern, region, "section_<section>_area", section.name);
  const Names names{section.name};
  if (options.given("section_<section>_profile", names)) {
    options.text("section_<section>_profile", names);  // its numbers are among the options already
  }
  options.read(section, names);
  if (options.given("section_<section>_shear_area", names)) {
    const std::vector<double> areas = options.reals("section_<section>_shear_area", names, 2);
    section.shear_area_y = areas[0];
    section.shear_area_z = areas[1];
  }
  options.refuse_if(section.z_axis == Vector3{0, 0, 0}, "section_<section>_z_axis", names,
                    "no direction");
  return section;
}

/// Into how many beams each line is cut; 0: as its waves need.
int read_parts(OptionReader& options, const Names& names) {
  constexpr std::string_view pattern = "<structure>_<group>_divide";
  constexpr double most = 1000;
  const std::string word = options.text(pattern, names);
  if (word == "none") return 1;
  if (word == "auto") return 0;
  const auto count = parse_real(word);
  options.refuse_if(!count || *count != std::floor(*count) || *count < 2 || *count > most, pattern,
                    names);
  return static_cast<int>(*count);
}

/// Reads the properties that elements with a shape need.
void read_solid(OptionReader& options, const Names& names, Region& region) {
  constexpr std::string_view area = "<structure>_<group>_area";
  const bool dashpot_alone = is_bar(region.element) && !options.given(area, names) &&
                             options.given("<structure>_<group>_dashpot", names);
  if (dashpot_alone) {
    options.forbid_each(
        "<structure>_<group>_", {"material", "tension_only", "compression_only"}, names,
        "a bar of its dashpot alone has none; give -<structure>_<group>_area as well");
  } else {
    region.material = read_material(options, names);
  }
  require_density(options, region);
  if (is_beam(region.element)) {
    region.section = read_section(options, names);
    region.parts = read_parts(options, names);
    read_yielding_section(options, names, region);
  }
  if (is_bar(region.element)) {
    if (!dashpot_alone) region.area = options.real(area, names);
    constexpr std::string_view pressed = "<structure>_<group>_compression_only";
    const bool pulled = options.boolean("<structure>_<group>_tension_only", names);
    region.compression_only = options.boolean(pressed, names);
    options.refuse_if(pulled && region.compression_only, pressed, names,
                      "not beside tension_only; leave one of the two out");
    if (pulled || region.compression_only) region.element = ElementType::tension_bar;
    read_nonlinear_bar(options, names, region);
  }
  if (is_shell(region.element)) read_yielding_membrane(options, names, region);
}

}  // namespace

Region read_region(OptionReader& options, const Names& names, const Rayleigh& inherited) {
  Region region;
  region.group = names[1];
  const std::string element = options.choice("<structure>_<group>_element", names);
  region.element = element_of_word(element);
  forbid_others(options, element, names);
  options.read(region, names);
  if (has_extent(region.element)) {
    read_solid(options, names, region);
  } else if (is_spring(region.element)) {
    read_spring(options, names, region);
  } else if (region.rotary_inertia != Vector3{0, 0, 0}) {
    region.element = ElementType::point_mass6;
  }
  region.at_points = options.given(points_option, names);
  if (region.spread != Spread::none) {
    options.forbid(points_option, names,
                   "points have no lines or surfaces over which its springs could be spread");
  }
  region.damping = read_region_damping(options, names, region, inherited);
  scale_stiffness(region.stiffness_factor, region);
  return region;
}

}  // namespace pounding
