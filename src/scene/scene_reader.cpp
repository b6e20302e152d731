#include "scene/scene_reader.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "common/error.h"
#include "scene/nearest_name.h"
#include "scene/option_reader.h"
#include "scene/option_values.h"
#include "scene/unknown_options.h"

namespace pounding {
namespace {

using Names = OptionReader::Names;

/// The element of a word; what depends on other options is settled by the region's reader.
ElementType element_type(const std::string& word) {
  static const std::map<std::string, ElementType> types{
      {"hex8", ElementType::hex8},
      {"hex8_full", ElementType::hex8_full},
      {"shell", ElementType::shell4},
      {"beam", ElementType::beam},
      {"bar", ElementType::bar},
      {"point_mass", ElementType::point_mass},
      {"grounded_spring", ElementType::grounded_spring},
      {"spring", ElementType::spring}};
  return types.at(word);
}

/// Reads a scene block by block, in the order of the table.
class SceneReader {
 public:
  explicit SceneReader(const OptionsDatabase& database) : options_(database) {}

  ReadScene read() {
    read_run();
    for (const std::string& name : structure_names_) {
      scene_.structures.push_back(read_structure(name));
    }
    for (const std::string& name : contact_names_) {
      scene_.contacts.push_back(read_contact(name));
    }
    for (std::size_t d = 0; d < 3; ++d) {
      scene_.motion[d] = read_motion(direction_names[d]);
    }
    for (const std::string& name : probe_names_) {
      scene_.probes.push_back(read_probe(name));
    }
    read_spectra();
    refuse_unknown_options(options_.database(), structure_names_);
    return {scene_, resolved()};
  }

 private:
  void read_run() {
    scene_.title = options_.text("title");
    structure_names_ = names("structures");
    contact_names_ = names("contacts");
    probe_names_ = names("probes");
    scene_.end_time = options_.real("end_time");
    scene_.courant = options_.real("courant");
    scene_.time_step = options_.real("time_step");
    scene_.allow_unstable = options_.boolean("allow_unstable");
    scene_.modes = options_.integer("modes");
    scene_.gap_tolerance = options_.real("gap_tolerance");
    scene_.impact_merge_time = options_.real("impact_merge_time");
    scene_.output_interval = options_.real("output_interval");
    scene_.energy_interval = options_.integer("energy_interval");
    scene_.dry_run = options_.boolean("dry_run");
    scene_.output = options_.text("output");
    const std::string method = options_.choice("stiffness");
    scene_.stiffness = method == "auto"        ? StiffnessMethod::automatic
                       : method == "assembled" ? StiffnessMethod::assembled
                                               : StiffnessMethod::element;
    scene_.resampling =
        options_.choice("resampling") == "linear" ? Resampling::linear : Resampling::band_limited;
  }

  /// A list of the user's names: letters, digits and _, none twice, none that is a word of ours.
  std::vector<std::string> names(std::string_view pattern) {
    std::vector<std::string> list = options_.list(pattern);
    for (const std::string& name : list) {
      const auto letter = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
      };
      if (!std::isalpha(static_cast<unsigned char>(name[0])) ||
          !std::ranges::all_of(name, letter)) {
        options_.refuse(pattern, {},
                        "'" + name + "' is not a name (a letter, then letters, digits, _)");
      }
      const bool reserved =
          name == "material" || name == "section" || name == "motion" || name == "spectra" ||
          std::ranges::any_of(option_table(),
                              [&](const OptionRow& row) { return row.pattern == name; });
      if (reserved) {
        options_.refuse(pattern, {},
                        "'" + name + "' is a word of the options, choose another name");
      }
      if (!used_names_.insert(name).second) {
        options_.refuse(pattern, {}, "'" + name + "' names something else already");
      }
    }
    return list;
  }

  Structure read_structure(const std::string& name) {
    Structure structure;
    structure.name = name;
    structure.mesh = options_.text("<structure>_mesh", {name});
    structure.mesh_set = read_mesh_set(name);
    structure.clamp = options_.list("<structure>_clamp", {name});
    options_.choice("<structure>_fidelity", {name});
    structure.initial_velocity = vector3("<structure>_initial_velocity", {name});
    structure.gravity = vector3("<structure>_gravity", {name});
    structure.damping = read_damping(name);
    for (const std::string& group : groups_of(name)) {
      structure.regions.push_back(read_region(name, group));
    }
    if (structure.regions.empty()) {
      throw UserError("structure " + name + " has no elements: give -" + name +
                      "_GROUP_element for at least one physical group of its mesh");
    }
    return structure;
  }

  Vector3 vector3(std::string_view pattern, const Names& names) {
    const std::vector<double> values = options_.reals(pattern, names, 3);
    return {values[0], values[1], values[2]};
  }

  std::vector<std::pair<std::string, std::string>> read_mesh_set(const std::string& name) {
    std::vector<std::pair<std::string, std::string>> pairs;
    for (const std::string& item : options_.list("<structure>_mesh_set", {name})) {
      const std::vector<std::string> sides = split(item, '=');
      if (sides.size() != 2 || sides[0].empty() || sides[1].empty()) {
        options_.refuse("<structure>_mesh_set", {name}, "'" + item + "' is not name=value");
      }
      pairs.emplace_back(sides[0], sides[1]);
    }
    return pairs;
  }

  Rayleigh read_damping(const std::string& name) {
    const Names names{name};
    if (!options_.given("<structure>_damping_ratio", names)) {
      options_.forbid("<structure>_damping_frequencies", names,
                      "goes with -" + name + "_damping_ratio, which is not given");
      return {options_.real("<structure>_damping_alpha", names),
              options_.real("<structure>_damping_beta", names)};
    }
    const std::string both = "give either alpha and beta, or ratio and frequencies";
    options_.forbid("<structure>_damping_alpha", names, both);
    options_.forbid("<structure>_damping_beta", names, both);
    const double ratio = options_.real("<structure>_damping_ratio", names);
    const std::vector<double> f = options_.reals("<structure>_damping_frequencies", names, 2);
    const double w1 = 2 * std::numbers::pi * f[0];
    const double w2 = 2 * std::numbers::pi * f[1];
    return {2 * ratio * w1 * w2 / (w1 + w2), 2 * ratio / (w1 + w2)};
  }

  /// Groups that have any option of a region, in alphabetical order.
  std::set<std::string> groups_of(const std::string& structure) const {
    std::set<std::string> groups;
    for (const auto& [option, value] : options_.database()) {
      for (const OptionRow& row : option_table()) {
        if (row.block != OptionBlock::region || !option.starts_with(structure + "_")) {
          continue;
        }
        const std::string tail(row.pattern.substr(row.pattern.rfind('>') + 1));
        const std::size_t head = structure.size() + 1;
        if (option.ends_with(tail) && option.size() > head + tail.size()) {
          groups.insert(option.substr(head, option.size() - head - tail.size()));
        }
      }
    }
    return groups;
  }

  Region read_region(const std::string& structure, const std::string& group) {
    const Names names{structure, group};
    Region region;
    region.group = group;
    const std::string element = options_.choice("<structure>_<group>_element", names);
    region.element = element_type(element);
    forbid_others(element, names);
    const bool shapeless = region.element == ElementType::point_mass ||
                           region.element == ElementType::grounded_spring ||
                           region.element == ElementType::spring;
    if (!shapeless) {
      region.material = read_material(names);
    }
    switch (region.element) {
      case ElementType::beam:
        region.section = read_section(names);
        break;
      case ElementType::bar:
        region.area = options_.real("<structure>_<group>_area", names);
        if (options_.boolean("<structure>_<group>_tension_only", names)) {
          region.element = ElementType::tension_bar;
        }
        break;
      case ElementType::shell4:
        region.thickness = options_.real("<structure>_<group>_thickness", names);
        region.rotary_inertia_factor =
            options_.real("<structure>_<group>_rotary_inertia_factor", names);
        break;
      case ElementType::point_mass:
        region.mass = options_.real("<structure>_<group>_mass", names);
        region.rotary_inertia = vector3("<structure>_<group>_rotary_inertia", names);
        if (region.rotary_inertia != Vector3{0, 0, 0}) {
          region.element = ElementType::point_mass6;
        }
        break;
      case ElementType::grounded_spring:
      case ElementType::spring:
        read_spring(names, region);
        break;
      default:
        break;
    }
    return region;
  }

  /// Options that belong to another element than the region's.
  void forbid_others(const std::string& element, const Names& names) const {
    static const std::map<std::string, std::set<std::string>> belongs{
        {"section", {"beam"}},
        {"area", {"bar"}},
        {"tension_only", {"bar"}},
        {"thickness", {"shell"}},
        {"rotary_inertia_factor", {"shell"}},
        {"mass", {"point_mass"}},
        {"rotary_inertia", {"point_mass"}},
        {"stiffness", {"grounded_spring", "spring"}},
        {"dashpot", {"grounded_spring", "spring"}},
        {"material", {"hex8", "hex8_full", "shell", "beam", "bar"}}};
    for (const auto& [option, elements] : belongs) {
      if (!elements.contains(element)) {
        options_.forbid("<structure>_<group>_" + option, names, "not for element " + element);
      }
    }
  }

  void read_spring(const Names& names, Region& region) {
    const auto six = [&](std::string_view pattern) {
      std::vector<double> values = options_.reals(pattern, names);
      if (values.size() != 3 && values.size() != 6) {
        options_.refuse(pattern, names, "wrong count of numbers");
      }
      values.resize(6, 0.0);
      std::array<double, 6> result{};
      std::copy(values.begin(), values.end(), result.begin());
      return result;
    };
    region.stiffness = six("<structure>_<group>_stiffness");
    region.dashpot = six("<structure>_<group>_dashpot");
    bool rotations = false;
    for (std::size_t c = 3; c < 6; ++c) {
      rotations = rotations || region.stiffness[c] > 0 || region.dashpot[c] > 0;
    }
    if (rotations) {
      region.element = region.element == ElementType::spring ? ElementType::spring6
                                                             : ElementType::grounded_spring6;
    }
  }

  /// Refuses a name that has no option of its block.
  void require_defined(std::string_view pattern, const Names& names, const std::string& name,
                       const std::string& prefix, std::string_view first_option) const {
    std::vector<std::string> defined;
    for (const auto& [option, value] : options_.database()) {
      const std::string tail = "_" + std::string(first_option);
      if (option.starts_with(prefix) && option.ends_with(tail)) {
        defined.push_back(
            option.substr(prefix.size(), option.size() - prefix.size() - tail.size()));
      }
    }
    if (std::ranges::find(defined, name) == defined.end()) {
      options_.refuse(pattern, names,
                      "no option -" + prefix + name + "_" + std::string(first_option) +
                          suggestion(name, defined));
    }
  }

  Material read_material(const Names& region) {
    const std::string name = options_.text("<structure>_<group>_material", region);
    require_defined("<structure>_<group>_material", region, name, "material_", "young");
    return {name, options_.real("material_<material>_young", {name}),
            options_.real("material_<material>_poisson", {name}),
            options_.real("material_<material>_density", {name})};
  }

  Section read_section(const Names& region) {
    Section section;
    section.name = options_.text("<structure>_<group>_section", region);
    require_defined("<structure>_<group>_section", region, section.name, "section_", "area");
    const Names names{section.name};
    section.area = options_.real("section_<section>_area", names);
    section.inertia_y = options_.real("section_<section>_inertia_y", names);
    section.inertia_z = options_.real("section_<section>_inertia_z", names);
    section.torsion = options_.real("section_<section>_torsion", names);
    const std::vector<double> axis = options_.reals("section_<section>_z_axis", names, 3);
    std::copy(axis.begin(), axis.end(), section.z_axis.begin());
    if (section.z_axis == Vector3{0, 0, 0}) {
      options_.refuse("section_<section>_z_axis", names, "no direction");
    }
    return section;
  }

  ContactSide read_side(std::string_view pattern, const std::string& contact) {
    const std::vector<std::string> words = split(options_.text(pattern, {contact}), ':');
    if (words.size() != 2 || words[0].empty() || words[1].empty()) {
      options_.refuse(pattern, {contact});
    }
    require_structure(pattern, {contact}, words[0]);
    return {words[0], words[1]};
  }

  void require_structure(std::string_view pattern, const Names& names,
                         const std::string& structure) const {
    if (std::ranges::find(structure_names_, structure) == structure_names_.end()) {
      options_.refuse(
          pattern, names,
          "there is no structure '" + structure + "'" + suggestion(structure, structure_names_));
    }
  }

  Contact read_contact(const std::string& name) {
    Contact contact;
    contact.name = name;
    contact.secondary = read_side("<contact>_secondary", name);
    contact.primary = options_.text("<contact>_primary", {name}) == "wall"
                          ? ContactSide{"wall", ""}
                          : read_side("<contact>_primary", name);
    contact.passes = options_.integer("<contact>_passes", {name});
    if (contact.primary.is_wall() && options_.text("<contact>_gap", {name}) == "geometry") {
      options_.refuse("<contact>_gap", {name}, "a wall has no geometry, give its distance");
    }
    if (contact.primary.is_wall() && contact.passes != 1) {
      options_.refuse("<contact>_passes", {name}, "a wall has no nodes");
    }
    if (options_.text("<contact>_gap", {name}) != "geometry") {
      contact.gap.values = options_.reals("<contact>_gap", {name});
      const std::size_t count = contact.gap.values.size();
      if (count != 1 && count != 2 && count != 4) {
        options_.refuse("<contact>_gap", {name}, "wrong count of numbers");
      }
    }
    return contact;
  }

  std::optional<MotionComponent> read_motion(const std::string& direction) {
    const Names names{direction};
    const std::string record = options_.text("motion_<x|y|z>_record", names);
    const bool silent = options_.given("motion_<x|y|z>_record", names) && record == "none";
    const bool synthetic = record == "none" && options_.given("motion_<x|y|z>_target", names);
    if (silent || (record == "none" && !synthetic)) {
      return std::nullopt;
    }
    MotionComponent component;
    component.pga = options_.real("motion_<x|y|z>_pga", names);
    component.scale = options_.real("motion_<x|y|z>_scale", names);
    if (synthetic) {
      component.source = read_synthetic(names);
      if (!(component.pga > 0)) {
        options_.refuse("motion_<x|y|z>_pga", names, "a synthetic motion needs a peak to scale to");
      }
    } else {
      const std::string unit = options_.choice("motion_<x|y|z>_unit", names);
      component.source = RecordedMotion{record, unit == "auto" ? "" : unit,
                                        options_.real("motion_<x|y|z>_time_step", names),
                                        options_.integer("motion_<x|y|z>_column", names)};
    }
    return component;
  }

  SyntheticMotion read_synthetic(const Names& names) {
    SyntheticMotion motion;
    motion.target = options_.text("motion_<x|y|z>_target", names);
    motion.seed = options_.integer("motion_<x|y|z>_seed", names);
    motion.duration = options_.real("motion_<x|y|z>_duration", names);
    const std::vector<double> envelope = options_.reals("motion_<x|y|z>_envelope", names, 2);
    motion.envelope = {envelope[0], envelope[1]};
    if (motion.envelope[0] > motion.envelope[1] || motion.envelope[1] > motion.duration) {
      options_.refuse("motion_<x|y|z>_envelope", names,
                      "the duration is " + std::to_string(motion.duration) + " s");
    }
    return motion;
  }

  Probe read_probe(const std::string& name) {
    Probe probe;
    probe.name = name;
    probe.structure = options_.text("<probe>_structure", {name});
    require_structure("<probe>_structure", {name}, probe.structure);
    const bool at = options_.given("<probe>_at", {name});
    if (at == options_.given("<probe>_group", {name})) {
      throw UserError("probe " + name + ": give one of -" + name + "_at and -" + name + "_group");
    }
    if (at) {
      probe.points = read_points(name);
    } else {
      probe.group = options_.text("<probe>_group", {name});
    }
    probe.average = options_.boolean("<probe>_average", {name});
    return probe;
  }

  std::vector<Vector3> read_points(const std::string& probe) {
    std::vector<Vector3> points;
    for (const std::string& item : split(options_.text("<probe>_at", {probe}), ';')) {
      const auto numbers = parse_reals(item);
      if (!numbers || numbers->size() != 3) {
        options_.refuse("<probe>_at", {probe}, "'" + item + "' is not a point");
      }
      points.push_back({(*numbers)[0], (*numbers)[1], (*numbers)[2]});
    }
    return points;
  }

  void read_spectra() {
    scene_.spectra.damping_ratios = options_.reals("spectra_damping");
    const auto frequencies = parse_increasing(options_.text("spectra_frequencies"));
    if (!frequencies || !(frequencies->front() > 0)) {
      options_.refuse("spectra_frequencies", {});
    }
    scene_.spectra.frequencies = *frequencies;
  }

  std::string resolved() const {
    std::string text =
        "# All options in force, defaults included; running this file repeats the run.\n";
    for (const auto& [name, value] : options_.in_force()) {
      text += name + ": \"";
      for (const char c : value) {
        text += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
      }
      text += "\"\n";
    }
    return text;
  }

  OptionReader options_;
  Scene scene_;
  std::vector<std::string> structure_names_;
  std::vector<std::string> contact_names_;
  std::vector<std::string> probe_names_;
  std::set<std::string> used_names_;
};

}  // namespace

ReadScene read_scene(const OptionsDatabase& database) {
  return SceneReader(database).read();
}

}  // namespace pounding
