#include "scene/load_reader.h"

#include <algorithm>

#include "common/matrix3.h"
#include "scene/option_values.h"
#include "scene/structure_reader.h"

namespace pounding {
namespace {

using Names = OptionReader::Names;

void read_place(OptionReader& options, const Scene& scene, Load& load) {
  constexpr std::string_view pattern = "<load>_on";
  const std::vector<std::string> words = split(options.text(pattern, {load.name}), ':');
  options.refuse_if(words.size() != 2 || words[0].empty() || words[1].empty(), pattern,
                    {load.name});
  load.structure = words[0];
  load.group = words[1];
  const Structure& structure =
      named_structure(options, scene, pattern, {load.name}, load.structure);
  options.refuse_if(!structure.matrices.empty(), pattern, {load.name},
                    "structure " + load.structure + " is made of matrices, which have no groups");
}

void require_force(const OptionReader& options, const Load& load) {
  const Vector3 zero{0, 0, 0};
  options.refuse_if(load.force == zero && load.moment == zero && load.line_force == zero &&
                        load.surface_force == zero && load.body_force == zero && load.pressure == 0,
                    "<load>_on", {load.name},
                    "the load is none: give -<load>_force, _moment, _line_force, _surface_force, "
                    "_pressure or _body_force");
}

/// Pairs of time and value, "0,0; 0.1,1".
void read_values(OptionReader& options, const std::string& name, LoadFunction& function) {
  constexpr std::string_view pattern = "<load>_values";
  for (const std::string& pair : split(options.text(pattern, {name}), ';')) {
    const auto numbers = parse_reals(pair);
    options.refuse_if(!numbers || numbers->size() != 2, pattern, {name},
                      "'" + pair + "' is no pair of time and value");
    options.refuse_if(!function.times.empty() && !((*numbers)[0] > function.times.back()), pattern,
                      {name}, "times do not increase");
    function.times.push_back((*numbers)[0]);
    function.values.push_back((*numbers)[1]);
  }
}

void read_function(OptionReader& options, const std::string& name, LoadFunction& function) {
  constexpr std::array<std::string_view, 3> kinds{"<load>_function", "<load>_table",
                                                  "<load>_values"};
  std::string_view chosen;
  for (const std::string_view kind : kinds) {
    if (!options.given(kind, {name})) continue;
    options.refuse_if(!chosen.empty(), kind, {name},
                      "the load has a history already, by -" + std::string(chosen));
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
void check_group(const OptionReader& options, const Structure& structure, const ForceItem& force) {
  options.refuse_if(force.group.empty(), "<force>_kind", {force.name},
                    "it is about elements: give -<force>_group as well");
  const auto region = std::ranges::find(structure.regions, force.group, &Region::group);
  options.refuse_if(region == structure.regions.end(), "<force>_group", {force.name},
                    "structure " + structure.name + " has no elements in such a group");
  const std::string reason = reason_against(force.kind, region->element);
  if (!reason.empty()) options.refuse("<force>_group", {force.name}, reason);
  options.refuse_if(
      is_nonlinear(*region), "<force>_group", {force.name},
      "its elements follow a law: give -loops " + structure.name + ":" + force.group + " instead");
}

/// Where a storey or a cut is.
void check_level(const OptionReader& options, ForceItem& force) {
  options.refuse_if(!options.given("<force>_level", {force.name}), "<force>_kind", {force.name},
                    "give -<force>_level as well, the z of the cut");
  force.normal = normalised(force.normal);
  options.refuse_if(force.normal == Vector3{0, 0, 0}, "<force>_normal", {force.name},
                    "no direction");
}

}  // namespace

Load read_load(OptionReader& options, const Scene& scene, const std::string& name) {
  Load load;
  load.name = name;
  read_place(options, scene, load);
  read_function(options, name, load.function);
  options.read(load, {name});
  require_force(options, load);
  options.refuse_if(load.factor == 0, "<load>_factor", {name},
                    "the load is none; take it out of -loads");
  return load;
}

ForceItem read_force(OptionReader& options, const Scene& scene, const std::string& name) {
  ForceItem force;
  force.name = name;
  options.read(force, {name});
  const Structure& structure =
      named_structure(options, scene, "<force>_structure", {name}, force.structure);
  options.refuse_if(structure.modal && structure.p_delta && force.kind != ForceKind::shells,
                    "<force>_kind", {name},
                    "structure " + structure.name +
                        " is reduced, where its elements do not know the part of the weight (-" +
                        structure.name + "_p_delta); give -" + structure.name + "_model full");
  if (force.has_group()) check_group(options, structure, force);
  if (force.has_level()) check_level(options, force);
  return force;
}

}  // namespace pounding
