#include "mesh/mesh_builder.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include "common/error.h"
#include "common/integer_sets.h"
#include "elements/element_traits.h"
#include "mesh/element_checks.h"
#include "mesh/facet_point.h"
#include "mesh/pool_water.h"
#include "mesh/probe_set.h"
#include "mesh/rigid_nodes.h"
#include "mesh/soil_node.h"
#include "mesh/tied_nodes.h"
#include "mesh/unused_elements.h"
#include "mesh/water_body.h"
#include "scene/law_kinds.h"
#include "scene/spring_reader.h"

namespace pounding {
namespace {

using Groups = std::map<std::string, std::vector<RawGroup>>;

/// Named physical groups; the same name in several dimensions is one group of several parts.
Groups physical_groups(const RawMesh& raw) {
  Groups groups;
  for (const RawGroup& group : raw.groups) groups[group.name].push_back(group);
  return groups;
}

/// The kind of element that a Gmsh type becomes in a region, or nothing if the region takes none of
/// it.
std::optional<ElementType> kind_in_region(ElementType wanted, int gmsh_type) {
  const ElementTraits& element = traits_of(wanted);
  if (gmsh_type == element.gmsh_type) return wanted;
  const bool fills = element.companion && gmsh_type == traits_of(*element.companion).gmsh_type;
  return fills ? element.companion : std::nullopt;
}

/// The dimension of the cells that a region takes.
int dimension_of(const Region& region) {
  if (region.spread != Spread::none) return region.spread == Spread::area ? 2 : 1;
  switch (traits_of(region.element).gmsh_type) {
    case 15:
      return 0;
    case 1:
      return 1;
    case 2:
    case 3:
      return 2;
    default:
      return 3;
  }
}

/// Parts of a group that a region takes: a name of several dimensions, as of a volume and its skin,
/// means those of the element that is asked for.
std::vector<RawGroup> region_parts(const Region& region, const std::vector<RawGroup>& group) {
  std::vector<RawGroup> parts;
  std::ranges::copy_if(group, std::back_inserter(parts), [&](const RawGroup& part) {
    return part.dimension == dimension_of(region);
  });
  return parts.empty() ? group : parts;
}

/// Reads region by region; node tags are translated to the file order at the end.
class MeshBuilder {
 public:
  MeshBuilder(const Structure& structure, RawMesh raw)
      : structure_(structure), raw_(std::move(raw)), groups_(physical_groups(raw_)) {
    for (const RawEntity& entity : raw_.entities) {
      entities_[{entity.dimension, entity.tag}] = &entity;
    }
  }

  GlobalMesh build() {
    for (const Region& region : structure_.regions) {
      if (!region.foundation && !region.at_points && !region.of_water) read_region(region);
    }
    number_nodes();
    share_out();
    for (const auto& [name, parts] : groups_) read_group(name, parts);
    add_point_groups(structure_, mesh_);
    mark_components();
    add_soil(structure_, mesh_);
    mark_rigid_groups();
    check_element_sizes(structure_.name, mesh_);
    check_repeated_elements(structure_.name, mesh_);
    read_water();
    std::ranges::move(find_unused(raw_, mesh_, taken_), std::back_inserter(mesh_.unused));
    add_pools(structure_, mesh_);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void unknown_group(const std::string& group, const std::string& option) const {
    throw UserError("option " + option + ": group '" + group + "' is not in " + structure_.mesh +
                    ", which has: " + (groups_.empty() ? "none" : group_names(groups_)));
  }

  void read_region(const Region& region) {
    const std::string option = "-" + structure_.name + "_" + region.group + "_element";
    const auto found = groups_.find(region.group);
    if (found == groups_.end()) unknown_group(region.group, option);
    const std::size_t before = mesh_.regions.size();
    for (const RawGroup& part : region_parts(region, found->second)) {
      taken_.insert({part.name, part.dimension});
      for (const int entity : part.entities) {
        const std::vector<RawElements>& elements = elements_on(part.dimension, entity);
        if (region.spread == Spread::none) {
          read_entity(region, option, elements);
        } else {
          read_spread(region, elements);
        }
      }
    }
    refuse_if(mesh_.regions.size() == before, "option " + option + ": group '" + region.group +
                                                  "' of " + structure_.mesh + " holds no elements");
  }

  const std::vector<RawElements>& elements_on(int dimension, int entity) const {
    static const std::vector<RawElements> none;
    const auto found = entities_.find({dimension, entity});
    return found == entities_.end() ? none : found->second->elements;
  }

  std::string kind_of(int gmsh_type) const {
    const auto found = std::ranges::find(raw_.types, gmsh_type, &RawType::type);
    return found == raw_.types.end() ? "unknown" : found->name;
  }

  void read_entity(const Region& region, const std::string& option,
                   const std::vector<RawElements>& parts) {
    for (const RawElements& part : parts) {
      const auto kind = kind_in_region(region.element, part.type);
      refuse_if(!kind, "option " + option + ": group '" + region.group + "' of " + structure_.mesh +
                           " holds " + kind_of(part.type) + " elements, which do not become " +
                           element_name(region.element) +
                           (is_grounded(region.element)
                                ? "; spread it, -" + structure_.name + "_" + region.group +
                                      "_stiffness_per_area or _per_length"
                                : ""));
      ElementSet& set = set_of(region, *kind);
      for (const std::int64_t tag : part.tags) {
        // Springs may share lines and points with another region (a mass on a spring).
        if (!seen_[is_spring(*kind) ? 1 : 0].insert(tag)) {
          throw UserError("option " + option + ": element " + std::to_string(tag) + " of group '" +
                          region.group +
                          "' is listed twice in it, or already belongs to another region of " +
                          structure_.name + "; name each element once");
        }
        set.tags.push_back(tag);
      }
      set.connectivity.insert(set.connectivity.end(), part.nodes.begin(), part.nodes.end());
    }
  }

  /// Facets or edges over which a region is spread, by the tags of their nodes.
  void read_spread(const Region& region, const std::vector<RawElements>& parts) {
    const bool area = region.spread == Spread::area;
    const std::string option =
        "-" + structure_.name + "_" + region.group + "_stiffness" + per_extent(region.spread);
    for (const RawElements& part : parts) {
      refuse_if(area ? part.type != 2 && part.type != 3 : part.type != 1,
                "option " + option + ": group '" + region.group + "' of " + structure_.mesh +
                    " holds " + kind_of(part.type) + " elements; " +
                    (area ? "it takes triangles and quadrangles" : "it takes lines of two nodes"));
      ElementSet& set = set_of(region, region.element);
      SpreadFacets& spread = spread_[&set - mesh_.regions.data()];
      const std::size_t width = part.nodes.size() / std::max<std::size_t>(1, part.tags.size());
      for (std::size_t e = 0; e < part.tags.size(); ++e) {
        if (!seen_[1].insert(part.tags[e])) {
          throw UserError(
              "option " + option + ": element " + std::to_string(part.tags[e]) + " of group '" +
              region.group +
              "' is listed twice in it, or already carries springs of another region of " +
              structure_.name + "; name each element once");
        }
        Facet facet;
        facet.count = static_cast<int>(width);
        std::copy_n(&part.nodes[e * width], width, facet.nodes.begin());
        spread.push_back(facet);
      }
      set.tags.insert(set.tags.end(), part.nodes.begin(), part.nodes.end());
      keep_once(set.tags);
      set.connectivity.assign(set.tags.begin(), set.tags.end());
    }
  }

  /// Share of each node in the length or area over which its region is spread.
  void share_out() {
    for (auto& [number, facets] : spread_) {
      drop_repeated_facets(facets);
      ElementSet& set = mesh_.regions[static_cast<std::size_t>(number)];
      set.share.assign(set.tags.size(), 0.0);
      for (Facet& facet : facets) {
        std::array<std::size_t, 4> places{};
        for (int a = 0; a < facet.count; ++a) {
          GlobalIndex& node = facet.nodes[static_cast<std::size_t>(a)];
          const auto found = std::ranges::lower_bound(set.tags, node);
          places[static_cast<std::size_t>(a)] = static_cast<std::size_t>(found - set.tags.begin());
          node = used_.index(node);
        }
        const std::array<double, 4> shares = facet_shares(mesh_, facet);
        for (std::size_t a = 0; a < static_cast<std::size_t>(facet.count); ++a) {
          set.share[places[a]] += shares[a];
        }
      }
    }
    spread_.clear();
  }

  /// The set of this kind in the region that is being read.
  ElementSet& set_of(const Region& region, ElementType kind) {
    const int number = static_cast<int>(&region - structure_.regions.data());
    for (ElementSet& set : mesh_.regions) {
      if (set.region == number && set.type == kind) return set;
    }
    ElementSet set;
    set.group = region.group;
    set.region = number;
    set.type = kind;
    set.inelastic = has_element_law(region);
    mesh_.regions.push_back(std::move(set));
    return mesh_.regions.back();
  }

  /// File order of the nodes in use, and their coordinates.
  void number_nodes() {
    for (const ElementSet& set : mesh_.regions) {
      for (const GlobalIndex node : set.connectivity) used_.insert(node);
    }
    mesh_.node_tags = used_.sort();
    for (ElementSet& set : mesh_.regions) {
      for (GlobalIndex& node : set.connectivity) node = used_.index(node);
    }
    mesh_.coordinates = coordinates_of(raw_, used_, mesh_.node_tags.size());
  }

  void read_group(const std::string& name, const std::vector<RawGroup>& parts) {
    NodeGroup& group = mesh_.groups[name];
    NumberSet nodes_in_use;
    for (const RawGroup& part : parts) {
      for (const int entity : part.entities) {
        for (const RawElements& elements : elements_on(part.dimension, entity)) {
          add_elements(part.dimension, elements, group, nodes_in_use);
        }
      }
    }
    group.nodes = nodes_in_use.sort();
    drop_repeated_facets(group.facets);
  }

  void add_elements(int dimension, const RawElements& elements, NodeGroup& group,
                    NumberSet& nodes_in_use) const {
    const std::size_t count = elements.tags.size();
    const std::size_t width = count == 0 ? 0 : elements.nodes.size() / count;
    for (std::size_t e = 0; e < count; ++e) {
      Facet facet;
      bool whole = (dimension == 1 || dimension == 2) && width <= 4;
      for (std::size_t a = 0; a < width; ++a) {
        const GlobalIndex node = used_.index(elements.nodes[e * width + a]);
        if (node < 0) {
          whole = false;
          continue;
        }
        nodes_in_use.insert(node);
        if (a < 4) facet.nodes[a] = node;
      }
      if (whole) {
        facet.count = static_cast<int>(width);
        group.facets.push_back(facet);
      }
    }
  }

  /// A group that an option of the structure names, with nodes of the scene.
  const NodeGroup& used_group(const std::string& name, const char* end_of_option) const {
    const auto found = mesh_.groups.find(name);
    const std::string option = "-" + structure_.name + end_of_option;
    if (found == mesh_.groups.end()) unknown_group(name, option);
    refuse_if(found->second.nodes.empty(),
              "option " + option + ": no element of the scene uses a node of group '" + name + "'");
    return found->second;
  }

  /// Water of the pools that have cells, which no region of the structure takes.
  void read_water() {
    for (const Pool& pool : structure_.pools) {
      if (pool.is_tank()) continue;
      const auto found = groups_.find(pool.water);
      if (found == groups_.end()) unknown_group(pool.water, "-" + pool.name + "_water");
      const GlobalMesh cells = water_cells(pool, found->second, raw_);
      taken_.insert({pool.water, 3});
      for (const ElementSet& set : cells.regions) {
        for (const std::int64_t tag : set.tags) {
          if (seen_[0].insert(tag)) continue;
          throw UserError("option -" + pool.name + "_water " + pool.water + ": cell " +
                          std::to_string(tag) + " is in another group with an element of " +
                          structure_.name + " or with water; name each cell once");
        }
      }
      std::vector<GlobalIndex> of_structure;
      for (const std::int64_t tag : cells.node_tags) of_structure.push_back(used_.index(tag));
      mesh_.water.push_back(join_water(pool, cells, of_structure));
    }
    check_wetted_nodes(mesh_);
  }

  void mark_rigid_groups() {
    for (const RigidGroup& rigid : structure_.rigid_groups) {
      const char* const end = std::strchr(rigid_option(rigid.kind), '_');
      used_group(rigid.group, end);
      if (!rigid.other.empty()) used_group(rigid.other, end);
    }
    mesh_.rigid = find_rigid_nodes(structure_, mesh_);
    add_tied_nodes(structure_, mesh_);
  }

  void mark_components() {
    mesh_.components.assign(mesh_.node_tags.size(), 0);
    for (const ElementSet& set : mesh_.regions) {
      const std::uint8_t mask = element_layout(set.type).components == 6 ? 0x3f : 0x07;
      for (const GlobalIndex node : set.connectivity) mesh_.components[node] |= mask;
    }
    mesh_.free_components = mesh_.components;
    for (const Clamp& clamp : structure_.clamps) {
      // Matrices leave clamped nodes out, and elements may as well.
      const auto found = mesh_.groups.find(clamp.group);
      const bool unused = found != mesh_.groups.end() && found->second.nodes.empty();
      if (unused && !structure_.matrices.empty()) continue;
      for (const GlobalIndex node : used_group(clamp.group, "_clamp").nodes) {
        mesh_.free_components[node] &= static_cast<std::uint8_t>(~clamp.components);
      }
    }
  }

  const Structure& structure_;
  RawMesh raw_;
  Groups groups_;
  std::map<std::pair<int, int>, const RawEntity*> entities_;  ///< by dimension and tag
  std::set<std::pair<std::string, int>> taken_;               ///< groups that became elements
  GlobalMesh mesh_;
  using SpreadFacets = std::vector<Facet>;
  std::map<std::ptrdiff_t, SpreadFacets> spread_;  ///< by set; nodes by their tags as yet
  NumberSet used_;                 ///< tags of nodes: the place of one is its number in mesh_
  std::array<NumberSet, 2> seen_;  ///< tags of elements, of springs
};

}  // namespace

GlobalMesh build_mesh(const Structure& structure, RawMesh raw) {
  return MeshBuilder(structure, std::move(raw)).build();
}

}  // namespace pounding
