#include "scene/force_reader.h"

#include <algorithm>

#include "scene/nearest_name.h"

namespace pounding {
namespace {

/// The structure of an item, which the scene must have.
const Structure& structure_of(OptionReader& options, const Scene& scene, const std::string& name) {
  const std::string wanted = options.text("<force>_structure", {name});
  const auto found = std::ranges::find(scene.structures, wanted, &Structure::name);
  if (found != scene.structures.end()) return *found;
  std::vector<std::string> known;
  for (const Structure& structure : scene.structures) known.push_back(structure.name);
  options.refuse("<force>_structure", {name},
                 "there is no structure '" + wanted + "'" + suggestion(wanted, known));
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
  if (!joins_two_nodes(region->element) && !is_spring(region->element)) {
    options.refuse("<force>_group", {force.name},
                   "its elements are neither beams nor bars nor springs");
  }
  if (follows_law(*region)) {
    options.refuse("<force>_group", {force.name},
                   "its elements follow a law: give -loops " + structure.name + ":" + force.group +
                       " instead");
  }
  if (options.given("<force>_at", {force.name})) {
    force.points = options.points("<force>_at", {force.name});
  }
}

}  // namespace

ForceItem read_force(OptionReader& options, const Scene& scene, const std::string& name) {
  ForceItem force;
  force.name = name;
  const Structure& structure = structure_of(options, scene, name);
  force.structure = structure.name;
  const std::string kind = options.choice("<force>_kind", {name});
  force.kind = kind == "reactions" ? ForceKind::reactions
               : kind == "storey"  ? ForceKind::storey
                                   : ForceKind::members;
  const bool of_elements = force.kind == ForceKind::members;
  const auto only_for = [&](bool used, std::string_view pattern, const std::string& kinds) {
    if (!used) options.forbid(pattern, {name}, "only with -" + name + "_kind " + kinds);
  };
  only_for(of_elements, "<force>_group", "members");
  only_for(of_elements, "<force>_at", "members");
  only_for(force.kind == ForceKind::storey, "<force>_level", "storey");
  only_for(!of_elements, "<force>_about", "reactions or storey");
  if (of_elements) read_group(options, structure, force);
  if (force.kind == ForceKind::storey) {
    if (!options.given("<force>_level", {name})) {
      options.refuse("<force>_kind", {name}, "give -" + name + "_level as well, the z of the cut");
    }
    force.level = options.real("<force>_level", {name});
  }
  if (!of_elements && options.given("<force>_about", {name})) {
    const std::vector<double> point = options.reals("<force>_about", {name}, 3);
    force.about = Vector3{point[0], point[1], point[2]};
  }
  return force;
}

}  // namespace pounding
