#include "scene/structure_reader.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <set>

#include "common/error.h"
#include "scene/damping_reader.h"
#include "scene/held_nodes_reader.h"
#include "scene/modal_reader.h"
#include "scene/option_blocks.h"
#include "scene/option_values.h"
#include "scene/region_reader.h"
#include "scene/soil_reader.h"

namespace pounding {
namespace {

using Names = OptionReader::Names;

/// Groups that are given by points. `groups`: all that have options; those without any other have
/// no element, and are taken out.
std::vector<PointGroup> read_point_groups(OptionReader& options, const std::string& structure,
                                          std::set<std::string>& groups) {
  std::vector<PointGroup> found;
  std::erase_if(groups, [&](const std::string& group) {
    const Names names{structure, group};
    if (!options.given(points_option, names)) return false;
    found.push_back(
        {group, option_name(points_option, names), options.points(points_option, names)});
    return std::ranges::none_of(option_table(), [&](const OptionRow& row) {
      return row.block == OptionBlock::region && row.pattern != points_option &&
             options.given(row.pattern, names);
    });
  });
  return found;
}

/// A name that Gmsh's language takes for a variable.
bool is_parameter(const std::string& name) {
  return std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
         std::ranges::all_of(name,
                             [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

/// A value that can be put between quotes in Gmsh's language.
bool is_plain(const std::string& value) {
  return std::ranges::none_of(value, [](unsigned char c) {
    return std::iscntrl(c) != 0 || c == '"' || c == '\'' || c == '\\';
  });
}

/// Gmsh counts cells with four bytes, and takes numbers beyond these for others.
constexpr double largest_parameter = 1e12;

std::vector<std::pair<std::string, std::string>> read_mesh_set(OptionReader& options,
                                                               const std::string& structure) {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const std::string& item : options.list("<structure>_mesh_set", {structure})) {
    const std::vector<std::string> sides = split(item, '=');
    options.refuse_if(sides.size() != 2 || sides[0].empty() || sides[1].empty(),
                      "<structure>_mesh_set", {structure}, "'" + item + "' is not name=value");
    options.refuse_if(
        !is_parameter(sides[0]) || !is_plain(sides[1]), "<structure>_mesh_set", {structure},
        "a name takes letters, digits and _, a value no quotes and no control characters");
    char* end = nullptr;
    const double number = std::strtod(sides[1].c_str(), &end);
    options.refuse_if(
        *end == '\0' && !(std::abs(number) <= largest_parameter), "<structure>_mesh_set",
        {structure}, sides[0] + "=" + sides[1] + " is beyond every mesh; give a number below 1e12");
    for (const auto& [name, value] : pairs) {
      options.refuse_if(name == sides[0], "<structure>_mesh_set", {structure},
                        name + " is set twice");
    }
    pairs.emplace_back(sides[0], sides[1]);
  }
  return pairs;
}

/// Refuses a group that has options but no element: a missing line, or a misspelt group.
void require_elements(const OptionReader& options, const std::string& structure,
                      const std::set<std::string>& groups) {
  const std::string_view pattern = "<structure>_<group>_element";
  std::vector<std::string> complete;
  std::ranges::copy_if(groups, std::back_inserter(complete), [&](const std::string& group) {
    return options.given(pattern, {structure, group});
  });
  for (const std::string& group : groups) {
    refuse_if(!options.given(pattern, {structure, group}),
              "missing option -" + option_name(pattern, {structure, group}) + ": group " + group +
                  " of structure " + structure + " has other options; expected " +
                  expected_text(option_row(pattern)) + suggestion(group, complete));
  }
  refuse_if(groups.empty(), "structure " + structure + " has no elements: give -" +
                                option_name(pattern, {structure, "GROUP"}) +
                                " for at least one physical group of its mesh");
}

/// The target of the time step is the wish of mass scaling as well.
void read_step_target(OptionReader& options, Structure& structure) {
  constexpr std::string_view target = "<structure>_time_step_target";
  const Names names{structure.name};
  StepTarget wish;
  options.read(wish, names);
  if (!wish.is_wanted()) return;
  const auto refuse_beside = [&](bool given, const std::string& option) {
    options.refuse_if(given, target, names, "not with -<structure>_" + option);
  };
  refuse_beside(structure.mass_scaling > 0, "mass_scaling, which it chooses");
  refuse_beside(!structure.matrices.empty(), "matrices");
  refuse_beside(structure.modal.has_value(),
                "model modal, whose coordinates -<structure>_mass_scaling slows down");
  structure.mass_scaling = wish.time_step;
  structure.step_target = wish;
}

/// The axial forces at rest belong to beams and bars whose mass nobody scales by their stiffness.
void check_p_delta(const OptionReader& options, const Structure& structure) {
  if (!structure.p_delta) return;
  const auto refuse_if = [&](bool wrong, const char* why) {
    options.refuse_if(wrong, "<structure>_p_delta", {structure.name}, why);
  };
  refuse_if(!structure.matrices.empty(), "not with -<structure>_matrices, which hold it or not");
  refuse_if(structure.mass_scaling > 0, "not with -<structure>_mass_scaling or _time_step_target");
  const auto bears = [](const Region& region) {
    return is_beam(region.element) || region.element == ElementType::bar;
  };
  refuse_if(std::ranges::none_of(structure.regions, bears),
            "the structure has no beams or bars, whose axial forces it is about");
}

/// Hexahedra alone have so many numbers that it pays.
void check_numbers(const OptionReader& options, const Structure& structure) {
  constexpr std::string_view pattern = "<structure>_numbers";
  if (structure.numbers == Numbers::in_double) return;
  options.refuse_if(!structure.matrices.empty(), pattern, {structure.name},
                    "not with -<structure>_matrices");
  const bool has_any = std::ranges::any_of(structure.regions, [](const Region& region) {
    return traits_of(region.element).kernel == ElementKernel::brick;
  });
  options.refuse_if(!has_any, pattern, {structure.name},
                    "the structure has no hexahedra, whose numbers it is about");
}

/// Matrices do not know which of their rows buckle, lift off or yield, which are of a group, nor
/// which nodes move together.
void check_matrices(const OptionReader& options, const Structure& structure) {
  if (structure.matrices.empty()) return;
  const std::string why = "not with -<structure>_matrices";
  for (const Region& region : structure.regions) {
    const Names names{structure.name, region.group};
    options.refuse_if(region.stiffness_factor != 1, "<structure>_<group>_stiffness_factor", names,
                      why);
    if (const LawKind* law = is_nonlinear.of(region)) options.refuse(law->option, names, why);
  }
  for (const RigidGroup& rigid : structure.rigid_groups) {
    options.refuse(rigid_option(rigid.kind), {structure.name}, why);
  }
}

/// Beside matrices no element makes damping: it has to be in the files.
void forbid_damping_of_regions(const OptionReader& options, const Structure& structure) {
  const std::string remedy =
      "would be lost beside -<structure>_matrices, which holds the damping of regions and dashpots "
      "in damping.mtx only; write it there and ";
  for (const Region& region : structure.regions) {
    const OptionReader::Names names{structure.name, region.group};
    if (std::ranges::any_of(region.dashpot, [](double rate) { return rate > 0; })) {
      options.forbid_each("<structure>_<group>_dashpot", {"", "_per_area", "_per_length"}, names,
                          remedy + "give 0 or nothing here");
    }
    const Rayleigh own = structure.damping_of(region);
    if (own.alpha != structure.damping.alpha || own.beta != structure.damping.beta) {
      forbid_damping(options, names, region, remedy + "give the structure's own here, or nothing");
    }
  }
}

}  // namespace

Structure read_structure(OptionReader& options, const std::string& name) {
  Structure structure;
  structure.name = name;
  options.read(structure, {name});
  structure.mesh_set = read_mesh_set(options, name);
  structure.clamps = read_clamps(options, name);
  structure.rigid_groups = read_rigid_groups(options, name);
  structure.uniform_damping = read_uniform_damping(options, name);
  if (!structure.uniform_damping) structure.damping = read_structure_damping(options, name);
  std::set<std::string> groups = region_groups(options.database(), name);
  structure.point_groups = read_point_groups(options, name, groups);
  require_elements(options, name, groups);
  for (const std::string& group : groups) {
    structure.regions.push_back(read_region(options, {name, group}, structure.damping));
  }
  check_matrices(options, structure);
  for (const Region& region : structure.regions) {  // filters follow the forces of all together
    if (!structure.uniform_damping) break;
    forbid_damping(options, {name, region.group}, region,
                   "not in a structure with -<structure>_damping_uniform, whose ratio is that of "
                   "all its elements");
  }
  read_model(options, structure);
  structure.absorbing = read_absorbing(options, structure);
  options.refuse_if(structure.mass_scaling > 0 && !structure.matrices.empty() && !structure.modal,
                    "<structure>_mass_scaling", {name}, "not with -<structure>_matrices");
  read_step_target(options, structure);
  if (!structure.matrices.empty()) forbid_damping_of_regions(options, structure);
  check_p_delta(options, structure);
  check_numbers(options, structure);
  structure.soil = read_soil(options, structure);
  if (structure.soil) structure.regions.push_back(soil_region(*structure.soil));
  make_mat_rigid(structure);
  return structure;
}

const Structure& named_structure(const OptionReader& options, const Scene& scene,
                                 std::string_view pattern, const Names& names,
                                 const std::string& structure, const std::string& hint) {
  const auto found = std::ranges::find(scene.structures, structure, &Structure::name);
  if (found != scene.structures.end()) return *found;
  options.refuse(pattern, names,
                 "there is no structure '" + structure + "'" +
                     suggestion(structure, names_of(scene.structures)) + hint);
}

void group_points(Scene& scene, const std::string& option, const std::string& structure,
                  const std::string& place) {
  PointGroup group{place, option, {}};
  for (const std::string& item : split(place, ';')) {
    const auto point = parse_point(item);
    if (!point) return;
    group.points.push_back(*point);
  }
  auto& groups = std::ranges::find(scene.structures, structure, &Structure::name)->point_groups;
  if (std::ranges::count(groups, place, &PointGroup::name) == 0) groups.push_back(group);
}

}  // namespace pounding
