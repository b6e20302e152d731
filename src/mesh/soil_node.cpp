#include "mesh/soil_node.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.h"

namespace pounding {
namespace {

void refuse_mat_if(bool wrong, const Structure& structure, const std::string& why) {
  refuse_if(wrong, "option -" + structure.name + "_soil_mat " + structure.soil->mat + ": " + why);
}

/// The node with rotations that is nearest to the middle in plan; of equally near ones the lowest,
/// then the first.
GlobalIndex carrying_node(const Structure& structure, const GlobalMesh& mesh,
                          const std::vector<GlobalIndex>& nodes) {
  const BoundingBox box = bounding_box(mesh, nodes);
  const double same = 1e-9 * std::max(box.diagonal(), 1e-300);
  GlobalIndex best = -1;
  double distance = std::numeric_limits<double>::infinity();
  for (const GlobalIndex node : nodes) {
    const std::size_t n = node;
    refuse_mat_if(mesh.components[n] != mesh.free_components[n], structure,
                  "the group has clamped nodes; soil holds a mat that nothing else holds");
    if ((mesh.components[n] & rotation_bits) != rotation_bits) continue;
    const Vector3 x = mesh.position(node);
    const double here =
        std::hypot(x[0] - (box.low[0] + box.high[0]) / 2, x[1] - (box.low[1] + box.high[1]) / 2);
    const bool lower =
        best >= 0 && std::abs(here - distance) <= same && x[2] < mesh.position(best)[2] - same;
    if (here < distance - same || lower) {
      best = node;
      distance = here;
    }
  }
  refuse_mat_if(
      best < 0, structure,
      "no node of the group has rotations; give it a node of shells or beams, or a point mass "
      "with rotary inertia");
  return best;
}

}  // namespace

void add_soil(const Structure& structure, GlobalMesh& mesh) {
  if (!structure.soil) return;
  const auto found = mesh.groups.find(structure.soil->mat);
  refuse_mat_if(found == mesh.groups.end() || found->second.nodes.empty(), structure,
                "no element of the scene uses a node of such a group of " + structure.mesh);
  const auto region = std::ranges::find(structure.regions, ElementType::soil, &Region::element);
  ElementSet set;
  set.group = region->group;
  set.region = static_cast<int>(region - structure.regions.begin());
  set.type = ElementType::soil;
  set.tags = {0};
  set.connectivity = {carrying_node(structure, mesh, found->second.nodes)};
  mesh.regions.push_back(std::move(set));
  if (!structure.soil->table.empty()) return;
  const MatOutline outline = mat_outline(structure, mesh);
  const std::array<double, 2> sides = sides_of(*structure.soil, outline);
  refuse_mat_if(!(sides[0] > 0) || !(sides[1] > 0), structure,
                "the nodes of the group span no area; give -" + structure.name + "_soil_size");
}

MatOutline mat_outline(const Structure& structure, const GlobalMesh& mesh) {
  const BoundingBox box = bounding_box(mesh, mesh.groups.at(structure.soil->mat).nodes);
  MatOutline outline;
  const auto soil = std::ranges::find(mesh.regions, ElementType::soil, &ElementSet::type);
  outline.node = mesh.position(soil->connectivity[0]);
  for (std::size_t d = 0; d < 2; ++d) {
    outline.centre[d] = (box.low[d] + box.high[d]) / 2;
    outline.sides[d] = box.high[d] - box.low[d];
  }
  outline.centre[2] = box.low[2];
  return outline;
}

}  // namespace pounding
