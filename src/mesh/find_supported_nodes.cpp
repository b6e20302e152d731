#include "mesh/find_supported_nodes.h"

#include <algorithm>
#include <map>

#include "common/error.h"
#include "scene/support_reader.h"

namespace pounding {
namespace {

[[noreturn]] void refuse_clamped(const Support& support, const SupportedGroup& group,
                                 const std::string& why) {
  throw UserError("option -" + support.name + "_groups " + group.structure + ":" + group.group +
                  ": " + why);
}

void refuse_ties(const Structure& structure, const GlobalMesh& mesh) {
  for (const RigidNodes& part : mesh.rigid) {
    for (const TiedNode& tied : part.tied) {
      bool held = mesh.clamped(tied.node) != 0;
      for (const Carrier& carrier : tied.carriers) held = held || mesh.clamped(carrier.node) != 0;
      if (held) {
        throw UserError("option -" + structure.name + "_tie " + part.group + ": the node at " +
                        place_text(mesh.position(tied.node)) +
                        " is clamped, or follows a clamped one, and the structure is on a "
                        "support that moves on its own; tie them elsewhere, or clamp less");
      }
    }
  }
}

/// Support of each clamped node; `all_ground`: that of all of them, or -1.
std::map<GlobalIndex, int> support_of_nodes(const Scene& scene, const Structure& structure,
                                            const GlobalMesh& mesh, int all_ground) {
  std::map<GlobalIndex, int> found;
  for (GlobalIndex node = 0; all_ground >= 0 && node < mesh.node_count(); ++node) {
    if (mesh.clamped(node) != 0) found.emplace(node, all_ground);
  }
  if (all_ground >= 0) return found;
  for (std::size_t s = 0; s < scene.supports.size(); ++s) {
    const Support& support = scene.supports[s];
    for (const SupportedGroup& group : support.groups) {
      if (group.structure != structure.name) continue;
      const auto nodes = mesh.groups.find(group.group);
      if (nodes == mesh.groups.end()) {
        refuse_clamped(support, group,
                       "there is no such group, the mesh has: " + group_names(mesh));
      }
      bool any = false;
      for (const GlobalIndex node : nodes->second.nodes) {
        if (mesh.clamped(node) == 0) continue;
        any = true;
        const auto [at, is_new] = found.try_emplace(node, static_cast<int>(s));
        if (!is_new && at->second != static_cast<int>(s)) {
          refuse_clamped(support, group,
                         "its clamped node at " + place_text(mesh.position(node)) +
                             " is on support " + scene.supports[at->second].name + " as well");
        }
      }
      if (!any) {
        refuse_clamped(support, group,
                       "no node of it is clamped; name it in -" + structure.name + "_clamp");
      }
    }
  }
  return found;
}

}  // namespace

void find_supported_nodes(const Scene& scene, const Structure& structure, GlobalMesh& mesh) {
  const int all_ground = support_of_all_ground(scene, structure);
  const std::map<GlobalIndex, int> found = support_of_nodes(scene, structure, mesh, all_ground);
  std::vector<SupportedNode> nodes;
  for (GlobalIndex node = 0; !found.empty() && node < mesh.node_count(); ++node) {
    if (mesh.clamped(node) == 0) continue;
    const auto at = found.find(node);
    if (at == found.end()) {
      throw UserError("structure " + structure.name + ": its clamped node at " +
                      place_text(mesh.position(node)) +
                      " is on none of -supports, and others of it do; name its group in the "
                      "_groups of one, which may move with the ground");
    }
    nodes.push_back({node, at->second, mesh.clamped(node)});
  }
  if (!stands_on_moving_support(scene, structure)) return;
  refuse_ties(structure, mesh);
  mesh.supported = std::move(nodes);
  mesh.ground_support = all_ground;
}

}  // namespace pounding
