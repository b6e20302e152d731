#include "mesh/water_body.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "common/error.h"
#include "common/matrix3.h"
#include "mesh/facet_point.h"

namespace pounding {
namespace {

/// Young's modulus with which the trace of a block (a, b) of a solid's stiffness, (lambda + 4 mu)
/// times the integral of grad N_a . grad N_b, is that integral; Poisson's ratio is 0.
constexpr double young_of_laplacian = 0.5;

void add(const Vector3& part, Vector3& sum) {
  for (std::size_t d = 0; d < 3; ++d) sum[d] += part[d];
}

class Joiner {
 public:
  Joiner(const Pool& pool, const GlobalMesh& cells, std::span<const GlobalIndex> of_structure)
      : pool_(pool),
        cells_(cells),
        of_structure_(of_structure),
        box_(bounding_box({&cells, 1})),
        area_(of_structure.size(), Vector3{0, 0, 0}),
        on_surface_(of_structure.size(), 0),
        lined_(of_structure.size(), 0),
        pieces_(of_structure.size()) {}

  WaterBody run() {
    for (const ElementSet& set : cells_.regions) {
      for (std::size_t e = 0; e < set.tags.size(); ++e) take_faces(set, e);
    }
    for (const auto& [key, facet] : boundary_) sort_face(facet);
    check_nodes();
    number_nodes();
    for (const ElementSet& set : cells_.regions) {
      for (std::size_t e = 0; e < set.tags.size(); ++e) add_cell(set, e);
    }
    describe();
    return std::move(water_);
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw UserError("option -" + pool_.name + "_water " + pool_.water + ": " + why);
  }

  /// Keeps the faces that one cell has alone, their corners going round the normal out of it.
  void take_faces(const ElementSet& set, std::size_t element) {
    const std::span<const GlobalIndex> nodes = set.nodes_of(element);
    for (const GlobalIndex node : nodes) {
      pieces_.join(static_cast<std::size_t>(node), static_cast<std::size_t>(nodes[0]));
    }
    const Vector3 middle = centroid(cells_, nodes);
    for (const ElementFace& face : traits_of(set.type).faces) {
      Facet facet;
      for (const std::size_t corner : face.corners()) {
        facet.nodes[static_cast<std::size_t>(facet.count++)] = nodes[corner];
      }
      Vector3 normal{0, 0, 0};
      for (const Vector3& share : facet_normal_shares(cells_, facet)) add(share, normal);
      if (dot(normal, minus(centroid(cells_, facet.corners()), middle)) < 0) {
        std::reverse(facet.nodes.begin(), facet.nodes.begin() + facet.count);
      }
      std::array<GlobalIndex, 4> key = facet.nodes;
      std::ranges::sort(key);
      if (const auto [place, fresh] = boundary_.emplace(key, facet); !fresh) boundary_.erase(place);
    }
  }

  void sort_face(const Facet& facet) {
    const auto is_top = [&](GlobalIndex node) {
      return cells_.position(node)[2] >= box_.high[2] - 1e-6 * box_.diagonal();
    };
    if (std::ranges::all_of(facet.corners(), is_top)) {
      for (const GlobalIndex node : facet.corners()) on_surface_[node] = 1;
      return;
    }
    const auto shares = facet_normal_shares(cells_, facet);
    for (std::size_t a = 0; a < facet.corners().size(); ++a) {
      const GlobalIndex node = facet.nodes[a];
      if (of_structure_[node] < 0) {
        refuse("its face around " + place_text(centroid(cells_, facet.corners())) +
               " is neither level at its highest nodes, a free surface, nor has it nodes of the "
               "structure alone; line it with elements, clamped where nothing moves");
      }
      lined_[node] = 1;
      add(shares[a], area_[node]);
    }
  }

  void check_nodes() {
    std::set<std::size_t> open;  // pieces with a free surface
    for (std::size_t n = 0; n < of_structure_.size(); ++n) {
      if (on_surface_[n] != 0) open.insert(pieces_.root(n));
    }
    bool wets = false;
    for (std::size_t n = 0; n < of_structure_.size(); ++n) {
      const Vector3 x = cells_.position(static_cast<GlobalIndex>(n));
      if (!open.contains(pieces_.root(n))) {
        refuse("the water around " + place_text(x) + " has no free surface: it would be shut in");
      }
      if (of_structure_[n] >= 0 && lined_[n] == 0 && on_surface_[n] == 0) {
        refuse("the node of the structure at " + place_text(x) +
               " has water all around; give the sides of a wall nodes of their own");
      }
      wets = wets || lined_[n] != 0;
    }
    if (!wets) refuse("its cells share no face with the structure; let them share its nodes");
  }

  /// Nodes with a pressure: those wetted in the order of the structure, then the others.
  void number_nodes() {
    std::vector<std::pair<GlobalIndex, std::size_t>> wetted;
    for (std::size_t n = 0; n < lined_.size(); ++n) {
      if (lined_[n] != 0 && on_surface_[n] == 0) wetted.emplace_back(of_structure_[n], n);
    }
    std::ranges::sort(wetted);
    number_.assign(lined_.size(), -1);
    for (const auto& [node, n] : wetted) {
      number_[n] = water_.pressures++;
      water_.nodes.push_back(node);
      water_.area.push_back(area_[n]);
    }
    for (std::size_t n = 0; n < lined_.size(); ++n) {
      if (number_[n] < 0 && on_surface_[n] == 0) number_[n] = water_.pressures++;
    }
  }

  void add_cell(const ElementSet& set, std::size_t element) {
    const std::span<const GlobalIndex> nodes = set.nodes_of(element);
    std::vector<double> coordinates;
    for (const GlobalIndex node : nodes) {
      const Vector3 x = cells_.position(node);
      coordinates.insert(coordinates.end(), x.begin(), x.end());
    }
    ElementProperties properties;
    properties.young = young_of_laplacian;
    properties.density = 1;
    const std::size_t size = coordinates.size();
    std::vector<double> stiffness(size * size);
    std::vector<double> volume(size);
    try {
      element_matrices(set.type, coordinates, properties, stiffness, volume);
    } catch (const ElementError& error) {
      refuse("its cell " + std::to_string(set.tags[element]) + " around " +
             place_text(centroid(cells_, nodes)) + " has a " + error.what());
    }
    for (std::size_t i = 0; i < size; i += 3) water_.outline.volume += volume[i];
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      for (std::size_t b = 0; b < nodes.size(); ++b) {
        const auto row = number_[static_cast<std::size_t>(nodes[a])];
        const auto column = number_[static_cast<std::size_t>(nodes[b])];
        if (row < 0 || column < 0) continue;
        double& entry = entries_[{row, column}];
        for (std::size_t d = 0; d < 3; ++d) entry += stiffness[(3 * a + d) * size + 3 * b + d];
      }
    }
  }

  void describe() {
    water_.pool = pool_.name;
    water_.density = pool_.density;
    water_.row_begin.assign(static_cast<std::size_t>(water_.pressures) + 1, 0);
    for (const auto& [place, value] : entries_) {
      ++water_.row_begin[static_cast<std::size_t>(place.first) + 1];
      water_.columns.push_back(place.second);
      water_.laplacian.push_back(value);
    }
    for (std::size_t i = 1; i < water_.row_begin.size(); ++i) {
      water_.row_begin[i] += water_.row_begin[i - 1];
    }
    PoolOutline& outline = water_.outline;
    outline.corner = box_.low;
    outline.sides = {box_.sides()[0], box_.sides()[1]};
    outline.depth = box_.sides()[2];
    outline.wetted = static_cast<GlobalIndex>(water_.nodes.size());
    outline.pressures = water_.pressures;
  }

  const Pool& pool_;
  const GlobalMesh& cells_;
  std::span<const GlobalIndex> of_structure_;
  BoundingBox box_;
  std::map<std::array<GlobalIndex, 4>, Facet> boundary_;
  std::vector<Vector3> area_;     ///< per node, out of the water [m2]
  std::vector<char> on_surface_;  ///< per node
  std::vector<char> lined_;       ///< per node: of a face that is not the surface
  DisjointSets pieces_;
  std::vector<std::int32_t> number_;  ///< per node, of its pressure; -1: 0 there
  std::map<std::pair<std::int32_t, std::int32_t>, double> entries_;  ///< of the Laplacian
  WaterBody water_;
};

}  // namespace

std::vector<double> coordinates_of(const RawMesh& raw, const NumberSet& nodes, std::size_t count) {
  std::vector<double> coordinates(3 * count);
  for (std::size_t i = 0; i < raw.node_tags.size(); ++i) {
    const GlobalIndex node = nodes.index(raw.node_tags[i]);
    if (node >= 0) std::copy_n(&raw.coordinates[3 * i], 3, &coordinates[3 * node]);
  }
  return coordinates;
}

GlobalMesh water_cells(const Pool& pool, const std::vector<RawGroup>& parts, const RawMesh& raw) {
  const std::string option = "option -" + pool.name + "_water " + pool.water + ": the group ";
  GlobalMesh cells;
  NumberSet nodes;
  for (const RawEntity& entity : raw.entities) {
    const bool within = std::ranges::any_of(parts, [&](const RawGroup& part) {
      return part.dimension == 3 && entity.dimension == 3 &&
             std::ranges::count(part.entities, entity.tag) > 0;
    });
    for (const RawElements& elements : entity.elements) {
      if (!within) continue;
      constexpr std::array kinds{ElementType::tet4, ElementType::hex8_full, ElementType::wedge6};
      const auto kind = std::ranges::find(
          kinds, elements.type, [](ElementType type) { return traits_of(type).gmsh_type; });
      if (kind == kinds.end()) {
        const auto found = std::ranges::find(raw.types, elements.type, &RawType::type);
        throw UserError(option + "holds " + found->name +
                        " elements; water has tetrahedra of 4 nodes, hexahedra of 8, wedges of 6");
      }
      for (const std::int64_t node : elements.nodes) nodes.insert(node);
      ElementSet& set = cells.regions.emplace_back();
      set.type = *kind;
      set.tags = elements.tags;
      set.connectivity = elements.nodes;
    }
  }
  if (cells.regions.empty()) throw UserError(option + "has no volume cells");
  cells.node_tags = nodes.sort();
  for (ElementSet& set : cells.regions) {
    for (GlobalIndex& node : set.connectivity) node = nodes.index(node);
  }
  cells.coordinates = coordinates_of(raw, nodes, cells.node_tags.size());
  return cells;
}

WaterBody join_water(const Pool& pool, const GlobalMesh& cells,
                     std::span<const GlobalIndex> of_structure) {
  return Joiner(pool, cells, of_structure).run();
}

void check_wetted_nodes(const GlobalMesh& mesh) {
  std::map<GlobalIndex, std::string> taken;
  for (const RigidNodes& part : mesh.rigid) {
    for (const GlobalIndex node : part.nodes) taken[node] = "moves with " + part.group;
  }
  for (const WaterBody& water : mesh.water) {
    for (const GlobalIndex node : water.nodes) {
      const auto [place, fresh] = taken.emplace(node, "is wetted by " + water.pool + " as well");
      if (fresh) continue;
      throw UserError("option -" + water.pool + "_water: the node at " +
                      place_text(mesh.position(node)) + " " + place->second +
                      ", which is not possible; give the water nodes of its own there");
    }
  }
}

}  // namespace pounding
