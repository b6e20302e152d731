#include "scene/load_reader.h"

#include <algorithm>
#include <array>
#include <utility>

#include "common/matrix3.h"
#include "scene/option_values.h"
#include "scene/structure_reader.h"

namespace pounding {
namespace {

using Names = OptionReader::Names;

/// Options of forces along the axes, and where a load keeps them.
constexpr std::array<std::pair<std::string_view, Vector3 Load::*>, 5> vector_options{
    {{"<load>_force", &Load::force},
     {"<load>_moment", &Load::moment},
     {"<load>_line_force", &Load::line_force},
     {"<load>_surface_force", &Load::surface_force},
     {"<load>_body_force", &Load::body_force}}};

void read_place(OptionReader& options, const Scene& scene, Load& load) {
  constexpr std::string_view pattern = "<load>_on";
  const std::vector<std::string> words = split(options.text(pattern, {load.name}), ':');
  if (words.size() != 2 || words[0].empty() || words[1].empty()) {
    options.refuse(pattern, {load.name});
  }
  load.structure = words[0];
  load.group = words[1];
  const Structure& structure = named_structure(options, scene, pattern, load.name, load.structure);
  if (!structure.matrices.empty()) {
    options.refuse(pattern, {load.name},
                   "structure " + load.structure + " is made of matrices, which have no groups");
  }
}

void read_forces(OptionReader& options, Load& load) {
  bool any = false;
  for (const auto& [pattern, member] : vector_options) {
    if (!options.given(pattern, {load.name})) continue;
    const std::vector<double> values = options.reals(pattern, {load.name}, 3);
    std::ranges::copy(values, (load.*member).begin());
    any = any || load.*member != Vector3{0, 0, 0};
  }
  if (options.given("<load>_pressure", {load.name})) {
    load.pressure = options.real("<load>_pressure", {load.name});
    any = any || load.pressure != 0;
  }
  if (!any) {
    options.refuse("<load>_on", {load.name},
                   "the load is none: give -" + load.name +
                       "_force, _moment, _line_force, _surface_force, _pressure or _body_force");
  }
}

/// Pairs of time and value, "0,0; 0.1,1".
void read_values(OptionReader& options, const std::string& name, LoadFunction& function) {
  constexpr std::string_view pattern = "<load>_values";
  for (const std::string& pair : split(options.text(pattern, {name}), ';')) {
    const auto numbers = parse_reals(pair);
    if (!numbers || numbers->size() != 2) {
      options.refuse(pattern, {name}, "'" + pair + "' is no pair of time and value");
    }
    if (!function.times.empty() && !((*numbers)[0] > function.times.back())) {
      options.refuse(pattern, {name}, "times do not increase");
    }
    function.times.push_back((*numbers)[0]);
    function.values.push_back((*numbers)[1]);
  }
}

/// Options that only some kinds of histories have.
void read_kind(OptionReader& options, const std::string& name, LoadFunction& function) {
  using Kind = LoadFunction::Kind;
  const auto take = [&](std::string_view pattern, bool has, double& value) {
    if (has) {
      value = options.real(pattern, {name});
    } else {
      options.forbid(pattern, {name}, "the history of load " + name + " has no such number");
    }
  };
  const bool harmonic = function.kind == Kind::harmonic;
  take("<load>_start", harmonic || function.kind == Kind::step || function.kind == Kind::ramp,
       function.start);
  take("<load>_rise", function.kind == Kind::ramp, function.rise);
  take("<load>_frequency", harmonic, function.frequency);
  take("<load>_phase", harmonic, function.phase);
}

void read_function(OptionReader& options, const std::string& name, LoadFunction& function) {
  constexpr std::array<std::string_view, 3> kinds{"<load>_function", "<load>_table",
                                                  "<load>_values"};
  std::string_view chosen;
  for (const std::string_view kind : kinds) {
    if (!options.given(kind, {name})) continue;
    if (!chosen.empty()) {
      options.refuse(kind, {name},
                     "the load has a history already, by -" + option_name(chosen, {name}));
    }
    chosen = kind;
  }
  if (chosen == kinds[1] || chosen == kinds[2]) {
    function.kind = LoadFunction::Kind::table;
    if (chosen == kinds[1]) {
      function.file = options.text(kinds[1], {name});
    } else {
      read_values(options, name, function);
    }
  } else {
    function.kind = options.choice_of<LoadFunction::Kind>(kinds[0], {name});
  }
  read_kind(options, name, function);
}

/// Why elements cannot have the forces that an item asks for; empty if they can.
std::string reason_against(ForceKind kind, ElementType element) {
  if (kind == ForceKind::shells) return is_shell(element) ? "" : "its elements are no shells";
  if (kind == ForceKind::members) {
    const bool has_ends = joins_two_nodes(element) || is_spring(element);
    return has_ends ? "" : "its elements are neither beams nor bars nor springs";
  }
  const bool passes = has_extent(element) || (is_spring(element) && !is_grounded(element));
  return passes ? "" : "its elements pass no force from one side of a plane to the other";
}

/// The group of an item, whose elements must have the forces that it asks for.
void read_group(OptionReader& options, const Structure& structure, ForceItem& force) {
  if (!options.given("<force>_group", {force.name})) {
    options.refuse("<force>_kind", {force.name},
                   "it is about elements: give -" + force.name + "_group as well");
  }
  force.group = options.text("<force>_group", {force.name});
  const auto region = std::ranges::find(structure.regions, force.group, &Region::group);
  if (region == structure.regions.end()) {
    options.refuse("<force>_group", {force.name},
                   "structure " + structure.name + " has no elements in such a group");
  }
  const std::string reason = reason_against(force.kind, region->element);
  if (!reason.empty()) options.refuse("<force>_group", {force.name}, reason);
  if (is_nonlinear(*region)) {
    options.refuse("<force>_group", {force.name},
                   "its elements follow a law: give -loops " + structure.name + ":" + force.group +
                       " instead");
  }
}

/// Where a storey or a cut is.
void read_level(OptionReader& options, ForceItem& force) {
  if (!options.given("<force>_level", {force.name})) {
    options.refuse("<force>_kind", {force.name},
                   "give -" + force.name + "_level as well, the z of the cut");
  }
  force.level = options.real("<force>_level", {force.name});
  if (!options.given("<force>_normal", {force.name})) return;
  const std::vector<double> normal = options.reals("<force>_normal", {force.name}, 3);
  force.normal = normalised({normal[0], normal[1], normal[2]});
  if (force.normal == Vector3{0, 0, 0}) {
    options.refuse("<force>_normal", {force.name}, "no direction");
  }
}

}  // namespace

Load read_load(OptionReader& options, const Scene& scene, const std::string& name) {
  Load load;
  load.name = name;
  read_place(options, scene, load);
  read_forces(options, load);
  load.factor = options.real("<load>_factor", {name});
  if (load.factor == 0) {
    options.refuse("<load>_factor", {name}, "the load is none; take it out of -loads");
  }
  read_function(options, name, load.function);
  return load;
}

ForceItem read_force(OptionReader& options, const Scene& scene, const std::string& name) {
  ForceItem force;
  force.name = name;
  const Structure& structure = named_structure(options, scene, "<force>_structure", name,
                                               options.text("<force>_structure", {name}));
  force.structure = structure.name;
  force.kind = options.choice_of<ForceKind>("<force>_kind", {name});
  if (structure.modal && structure.p_delta && force.kind != ForceKind::shells) {
    options.refuse("<force>_kind", {name},
                   "structure " + structure.name +
                       " is reduced, where its elements do not know the part of the weight (-" +
                       structure.name + "_p_delta); give -" + structure.name + "_model full");
  }
  const bool of_group = force.of_elements() || force.kind == ForceKind::cut;
  const auto only_for = [&](bool used, std::string_view pattern, const std::string& kinds) {
    if (!used) options.forbid(pattern, {name}, "only with -" + name + "_kind " + kinds);
  };
  only_for(of_group, "<force>_group", "members, shells or cut");
  only_for(force.of_elements(), "<force>_at", "members or shells");
  only_for(force.has_level(), "<force>_level", "storey or cut");
  only_for(force.kind == ForceKind::cut, "<force>_normal", "cut");
  only_for(!force.of_elements(), "<force>_about", "reactions, storey or cut");
  if (of_group) read_group(options, structure, force);
  if (force.of_elements() && options.given("<force>_at", {name})) {
    force.points = options.points("<force>_at", {name});
  }
  if (force.has_level()) read_level(options, force);
  if (!force.of_elements() && options.given("<force>_about", {name})) {
    const std::vector<double> point = options.reals("<force>_about", {name}, 3);
    force.about = Vector3{point[0], point[1], point[2]};
  }
  return force;
}

}  // namespace pounding
