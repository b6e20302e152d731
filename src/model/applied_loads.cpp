#include "model/applied_loads.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "common/error.h"
#include "common/facts.h"
#include "common/matrix3.h"
#include "elements/element_traits.h"
#include "interactions/pairing/facet_backing.h"
#include "mesh/element_properties.h"
#include "mesh/facet_point.h"

namespace pounding {
namespace {

constexpr Vector3 none{0, 0, 0};

/// Share of the sum of the sizes of all forces below which these cancel out.
constexpr double cancelled = 1e-9;

Vector3 times(double factor, const Vector3& v) {
  return {factor * v[0], factor * v[1], factor * v[2]};
}

/// Nodal forces of one load.
class LoadMaker {
 public:
  LoadMaker(const Load& load, const Structure& structure, const GlobalMesh& mesh)
      : load_(load), structure_(structure), mesh_(mesh) {
    const auto group = mesh.groups.find(load.group);
    if (group == mesh.groups.end() || group->second.nodes.empty()) {
      refuse("_on " + load.structure + ":" + load.group,
             "no element of the scene uses a node of such a group in " + structure.mesh +
                 "; a point is " + load.structure + ":x,y,z");
    }
    group_ = &group->second;
  }

  NodalLoad make() {
    add_nodal();
    if (load_.line_force != none) add_line_force();
    if (load_.surface_force != none) add_surface_force();
    if (load_.pressure != 0) add_pressure();
    if (load_.body_force != none) add_body_force();
    NodalLoad result;
    result.extent = extent_;
    std::set<GlobalIndex> nodes;
    for (const auto& [place, value] : forces_) {
      if (value == 0) continue;
      const auto& [node, component] = place;
      result.forces.push_back({node, component, value});
      nodes.insert(node);
      const auto d = static_cast<std::size_t>(component % 3);
      (component < 3 ? result.force : result.moment)[d] += value;
      if (component >= 3) continue;
      Vector3 force{};
      force[d] = value;
      const Vector3 turned = cross(mesh_.position(node), force);
      for (std::size_t k = 0; k < 3; ++k) result.moment[k] += turned[k];
    }
    result.nodes = static_cast<GlobalIndex>(nodes.size());
    return result;
  }

 private:
  [[noreturn]] void refuse(const std::string& option, const std::string& why) const {
    throw UserError("option -" + load_.name + option + ": " + why);
  }

  void add(GlobalIndex node, const Vector3& force, int first = 0) {
    for (int d = 0; d < 3; ++d) forces_[{node, first + d}] += force[static_cast<std::size_t>(d)];
  }

  void require_facets(bool lines, const char* option) const {
    const bool any = std::ranges::any_of(
        group_->facets, [&](const Facet& facet) { return (facet.count == 2) == lines; });
    if (any) return;
    refuse(option, "group " + load_.group + " of structure " + load_.structure + " has no " +
                       (lines ? "lines" : "surfaces") + " to act on; -" + load_.name +
                       "_force acts on its nodes");
  }

  void add_nodal() {
    for (const GlobalIndex node : group_->nodes) {
      if (load_.force != none) add(node, load_.force);
      if (load_.moment == none) continue;
      for (int c = 3; c < 6; ++c) {
        const bool turns = (mesh_.components[node] >> c & 1) != 0;
        if (load_.moment[static_cast<std::size_t>(c - 3)] == 0 || turns) continue;
        refuse("_moment", "node " + std::to_string(mesh_.node_tags[node]) + " of group " +
                              load_.group + " has no rotations; give forces");
      }
      add(node, load_.moment, 3);
    }
  }

  /// Lines of the mesh that are beams.
  std::set<std::pair<GlobalIndex, GlobalIndex>> beams() const {
    std::set<std::pair<GlobalIndex, GlobalIndex>> found;
    for (const ElementSet& set : mesh_.regions) {
      if (!is_beam(set.type)) continue;
      for (std::size_t e = 0; e < set.tags.size(); ++e) {
        found.insert(std::minmax(set.connectivity[2 * e], set.connectivity[2 * e + 1]));
      }
    }
    return found;
  }

  void add_line_force() {
    require_facets(true, "_line_force");
    const auto bending = beams();
    for (const Facet& line : group_->facets) {
      if (line.count != 2) continue;
      const auto [a, b] = std::pair(line.nodes[0], line.nodes[1]);
      const std::array<double, 4> shares = facet_shares(mesh_, line);
      add(a, times(shares[0], load_.line_force));
      add(b, times(shares[1], load_.line_force));
      extent_ += shares[0] + shares[1];
      if (!bending.contains(std::minmax(a, b))) continue;
      const Vector3 axis = minus(mesh_.position(b), mesh_.position(a));
      const Vector3 moment = times(norm(axis) / 12, cross(axis, load_.line_force));
      add(a, moment, 3);
      add(b, times(-1, moment), 3);
    }
  }

  void add_surface_force() {
    require_facets(false, "_surface_force");
    for (const Facet& facet : group_->facets) {
      if (facet.count == 2) continue;
      const std::array<double, 4> shares = facet_shares(mesh_, facet);
      for (std::size_t k = 0; k < facet.corners().size(); ++k) {
        add(facet.nodes[k], times(shares[k], load_.surface_force));
        extent_ += shares[k];
      }
    }
  }

  void add_pressure() {
    require_facets(false, "_pressure");
    std::vector<Facet> facets;
    std::ranges::copy_if(group_->facets, std::back_inserter(facets),
                         [](const Facet& facet) { return facet.count > 2; });
    const auto behind = interactions::elements_behind(mesh_, structure_.regions, facets);
    require_one_side(facets, behind);
    for (std::size_t f = 0; f < facets.size(); ++f) {
      const Vector3 out = behind[f].elements.front().area;
      const std::array<Vector3, 4> normals = facet_normal_shares(mesh_, facets[f]);
      for (std::size_t k = 0; k < facets[f].corners().size(); ++k) {
        const double side = dot(normals[k], out) < 0 ? 1 : -1;
        add(facets[f].nodes[k], times(side * load_.pressure, normals[k]));
        extent_ += norm(normals[k]);
      }
    }
  }

  /// Every facet has one outer side: that of the solid behind it, or of a shell that by which its
  /// neighbours are seen from the same side as well.
  void require_one_side(const std::vector<Facet>& facets,
                        const std::vector<interactions::FacetBacking>& behind) const {
    std::vector<char> shells(facets.size(), 0);
    for (std::size_t f = 0; f < facets.size(); ++f) {
      const auto& elements = behind[f].elements;
      shells[f] = !elements.empty() && elements.front().two_sided ? 1 : 0;
      const bool between = elements.size() > 1 && elements.front().solid;
      if (!elements.empty() && !between) continue;
      refuse("_pressure", "the facet at " + place_of(facets[f]) + " of group " + load_.group +
                              (between ? " lies between two solids, where no side is outside"
                                       : " is no face of a solid and no shell"));
    }
    const std::vector<char> reversed = interactions::reversed_shells(facets, shells);
    const auto odd = std::ranges::find_if(reversed, [](char reverse) { return reverse != 0; });
    if (odd == reversed.end()) return;
    refuse("_pressure",
           "the shell at " + place_of(facets[static_cast<std::size_t>(odd - reversed.begin())]) +
               " of group " + load_.group +
               " has its nodes in the other order than a shell beside it, so that a pressure would "
               "push and pull; turn the surfaces of the mesh alike, or give _surface_force");
  }

  std::string place_of(const Facet& facet) const {
    return place_text(centroid(mesh_, facet.corners()));
  }

  void add_body_force() {
    bool any = false;
    for (const ElementSet& set : mesh_.regions) {
      if (set.group != load_.group || !has_extent(set.type)) continue;
      any = true;
      add_volumes(set);
    }
    if (any) return;
    refuse("_body_force", "group " + load_.group + " of structure " + load_.structure +
                              " has no elements with a volume");
  }

  /// Volumes are the lumped masses of elements of density 1 that carry nothing.
  void add_volumes(const ElementSet& set) {
    ElementProperties properties =
        element_properties(structure_.regions[static_cast<std::size_t>(set.region)]);
    properties.density = 1;
    properties.added_mass = 0;
    const ElementLayout layout = element_layout(set.type);
    const auto nodes = static_cast<std::size_t>(layout.nodes);
    std::vector<double> coordinates(3 * nodes);
    std::vector<double> volume(static_cast<std::size_t>(layout.size()));
    for (std::size_t e = 0; e < set.tags.size(); ++e) {
      const GlobalIndex* const node = &set.connectivity[nodes * e];
      for (std::size_t a = 0; a < nodes; ++a) {
        std::ranges::copy(mesh_.position(node[a]), &coordinates[3 * a]);
      }
      std::ranges::fill(volume, 0.0);
      element_lumped_mass(set.type, coordinates, properties, volume);
      for (std::size_t a = 0; a < nodes; ++a) {
        const double share = volume[static_cast<std::size_t>(layout.components) * a];
        add(node[a], times(share, load_.body_force));
        extent_ += share;
      }
    }
  }

  const Load& load_;
  const Structure& structure_;
  const GlobalMesh& mesh_;
  const NodeGroup* group_ = nullptr;
  std::map<std::pair<GlobalIndex, int>, double> forces_;
  double extent_ = 0;
};

}  // namespace

std::vector<NodalLoad> find_loads(const Scene& scene, std::span<const GlobalMesh> meshes) {
  std::vector<NodalLoad> loads;
  for (const Load& load : scene.loads) {
    const std::size_t s = structure_number(scene, load.structure);
    try {
      loads.push_back(LoadMaker(load, scene.structures[s], meshes[s]).make());
    } catch (const ElementError& error) {
      throw UserError("load " + load.name + ": " + error.what());
    }
    loads.back().structure = static_cast<int>(s);
  }
  return loads;
}

std::vector<std::string> load_doubts(const Scene& scene, std::span<const GlobalMesh> meshes,
                                     std::span<const NodalLoad> loads) {
  std::vector<std::string> doubts;
  for (std::size_t l = 0; l < loads.size(); ++l) {
    const GlobalMesh& mesh = meshes[static_cast<std::size_t>(loads[l].structure)];
    double size = 0;
    double held = 0;
    for (const NodalValue& force : loads[l].forces) {
      size += std::abs(force.value);
      const bool free = (mesh.free_components[force.node] >> force.component & 1) != 0;
      held += free ? 0 : std::abs(force.value);
    }
    const std::string owner = "load " + scene.loads[l].name;
    if (held == size) {
      doubts.push_back(owner + ": all of it acts on clamped components, nothing feels it");
    } else if (held > size / 2) {
      doubts.push_back(
          sentence("{}: {:.2g %} of it acts on clamped components", {owner, held / size}));
    } else if (norm(loads[l].force) < cancelled * size &&
               norm(loads[l].moment) < cancelled * size) {
      doubts.push_back(owner + ": its forces cancel out");
    }
  }
  return doubts;
}

}  // namespace pounding
