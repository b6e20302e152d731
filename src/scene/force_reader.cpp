#include "scene/force_reader.h"

#include <algorithm>

#include "common/matrix3.h"
#include "scene/structure_reader.h"

namespace pounding {
namespace {

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
