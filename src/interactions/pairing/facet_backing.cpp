#include "interactions/pairing/facet_backing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "common/matrix3.h"
#include "elements/element_traits.h"

namespace pounding::interactions {
namespace {

/// A facet at an edge; `forward`: it runs along the edge from the lower to the higher node.
struct FacetAtEdge {
  std::size_t facet = 0;
  bool forward = false;
};

using Edge = std::pair<GlobalIndex, GlobalIndex>;

Edge edge_of(const Facet& facet, std::size_t side) {
  const auto corners = facet.corners();
  return {corners[side], corners[(side + 1) % corners.size()]};
}

Edge sorted(const Edge& edge) {
  return {std::min(edge.first, edge.second), std::max(edge.first, edge.second)};
}

/// Cosine above which two directions are one, below minus which they are opposed.
constexpr double alike = 0.99;
constexpr double opposed = -0.5;

/// Share of its thickness below which a shell does not reach beyond a facet: it lies along it.
constexpr double along = 0.1;

/// Twice the facet's area along its normal, for the node order of the facet.
Vector3 area_vector(const GlobalMesh& mesh, std::span<const GlobalIndex> nodes) {
  const auto at = [&](std::size_t i) { return mesh.position(nodes[i]); };
  if (nodes.size() == 3) return cross(minus(at(1), at(0)), minus(at(2), at(0)));
  return cross(minus(at(2), at(0)), minus(at(3), at(1)));
}

/// Area (length for an edge) of a facet along its normal away from a point.
Vector3 outward_area(const GlobalMesh& mesh, const Facet& facet, const Vector3& inside) {
  const Vector3 out = minus(centroid(mesh, facet.corners()), inside);
  if (facet.count == 2) {
    const Vector3 edge = minus(mesh.position(facet.nodes[1]), mesh.position(facet.nodes[0]));
    const double length = std::sqrt(dot(edge, edge));
    const Vector3 direction = normalised(edge);
    const double part = dot(out, direction);
    const Vector3 normal = normalised(
        {out[0] - part * direction[0], out[1] - part * direction[1], out[2] - part * direction[2]});
    return {length * normal[0], length * normal[1], length * normal[2]};
  }
  const Vector3 area = area_vector(mesh, facet.corners());
  return dot(area, out) < 0 ? Vector3{-area[0], -area[1], -area[2]} : area;
}

Backing make_backing(const GlobalMesh& mesh, const Facet& facet,
                     std::span<const GlobalIndex> element, bool shell, double thickness) {
  Backing backing;
  backing.two_sided = shell && static_cast<std::size_t>(facet.count) == element.size();
  backing.area = backing.two_sided ? area_vector(mesh, facet.corners())
                                   : outward_area(mesh, facet, centroid(mesh, element));
  backing.depth = thickness;
  if (!backing.two_sided) {
    const Vector3 normal = normalised(backing.area);
    const Vector3 middle = centroid(mesh, facet.corners());
    backing.depth = 0;
    for (const GlobalIndex node : element) {
      backing.depth = std::max(backing.depth, dot(normal, minus(middle, mesh.position(node))));
    }
  }
  return backing;
}

/// A beam whose axis the facet is.
Backing axis_of(int region) {
  Backing backing;
  backing.region = region;
  backing.beam = true;
  return backing;
}

/// Beams along the edge of a shell leave the edge to it; of several on one line the first stays.
void prefer_faces(FacetBacking& behind) {
  std::vector<Backing>& elements = behind.elements;
  const auto is_beam = [](const Backing& b) { return b.beam; };
  if (!std::ranges::all_of(elements, is_beam)) {
    std::erase_if(elements, is_beam);
  } else if (!elements.empty()) {
    elements.resize(1);
  }
}

/// A solid gives the outer side of a facet; a shell that lies on it does not.
void prefer_solids(FacetBacking& behind) {
  std::vector<Backing>& elements = behind.elements;
  if (std::ranges::any_of(elements, [](const Backing& b) { return !b.two_sided; })) {
    std::erase_if(elements, [](const Backing& b) { return b.two_sided; });
  }
}

bool lies_ahead(const Backing& other, const Backing& element) {
  if (other.beam || element.beam) return false;
  return dot(normalised(other.area), normalised(element.area)) < opposed;
}

}  // namespace

std::vector<char> reversed_shells(std::span<const Facet> facets, std::span<const char> shells) {
  std::map<Edge, std::vector<FacetAtEdge>> facets_at;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (std::size_t side = 0; shells[f] != 0 && side < facets[f].corners().size(); ++side) {
      const Edge edge = edge_of(facets[f], side);
      facets_at[sorted(edge)].push_back({f, edge.first < edge.second});
    }
  }
  std::vector<char> reversed(facets.size(), 0);
  std::vector<char> seen(facets.size(), 0);
  std::vector<std::size_t> queue;
  for (std::size_t first = 0; first < facets.size(); ++first) {
    if (shells[first] == 0 || seen[first] != 0) continue;
    seen[first] = 1;
    queue.assign(1, first);
    while (!queue.empty()) {
      const std::size_t f = queue.back();
      queue.pop_back();
      for (std::size_t side = 0; side < facets[f].corners().size(); ++side) {
        const Edge edge = edge_of(facets[f], side);
        const std::vector<FacetAtEdge>& there = facets_at.at(sorted(edge));
        for (const FacetAtEdge& other : there) {
          if (there.size() != 2 || seen[other.facet] != 0) continue;
          // Neighbours of one orientation run along their common edge in opposite directions.
          const bool forward = (edge.first < edge.second) != (reversed[f] != 0);
          reversed[other.facet] = other.forward == forward ? 1 : 0;
          seen[other.facet] = 1;
          queue.push_back(other.facet);
        }
      }
    }
  }
  return reversed;
}

std::vector<std::size_t> FacetBacking::outer() const {
  std::vector<std::size_t> found;
  for (const bool all : {false, true}) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const Backing& element = elements[i];
      const bool blocked = std::ranges::any_of(
          elements, [&](const Backing& other) { return lies_ahead(other, element); });
      const bool again = std::ranges::any_of(found, [&](std::size_t k) {
        return !element.beam && dot(normalised(elements[k].area), normalised(element.area)) > alike;
      });
      if ((all || !blocked) && !again) found.push_back(i);
    }
    if (!found.empty()) break;
  }
  return found;
}

bool FacetBacking::is_inner() const {
  return std::ranges::all_of(elements, [&](const Backing& element) {
    return std::ranges::any_of(elements,
                               [&](const Backing& other) { return lies_ahead(other, element); });
  });
}

double FacetBacking::half_thickness(const Vector3& direction) const {
  double half = 0;
  for (const ShellThere& shell : shells) {
    const double share = std::abs(dot(shell.normal, direction));
    half = std::max(half, share > along ? share * shell.thickness / 2 : 0.0);
  }
  return half;
}

std::vector<FacetBacking> elements_behind(const GlobalMesh& mesh, std::span<const Region> regions,
                                          const std::vector<Facet>& facets) {
  std::map<GlobalIndex, std::vector<std::size_t>> facets_at;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (const GlobalIndex node : facets[f].corners()) facets_at[node].push_back(f);
  }
  std::vector<FacetBacking> behind(facets.size());
  for (const ElementSet& set : mesh.regions) {
    const bool beam = is_beam(set.type);
    if (!carries_faces(set.type) && !beam) continue;
    const double thickness = regions[set.region].thickness;
    const std::size_t width = element_layout(set.type).nodes;
    for (std::size_t e = 0; e < set.tags.size(); ++e) {
      const std::span<const GlobalIndex> nodes(&set.connectivity[e * width], width);
      std::map<std::size_t, int> shared;
      for (const GlobalIndex node : nodes) {
        const auto found = facets_at.find(node);
        if (found != facets_at.end()) {
          for (const std::size_t f : found->second) ++shared[f];
        }
      }
      for (const auto& [f, count] : shared) {
        if (beam) {
          if (count == 2 && facets[f].count == 2) behind[f].elements.push_back(axis_of(set.region));
          continue;
        }
        // An edge of a solid is no face.
        if (count != facets[f].count || (count == 2 && !is_shell(set.type))) continue;
        Backing& backing = behind[f].elements.emplace_back(
            make_backing(mesh, facets[f], nodes, is_shell(set.type), thickness));
        backing.region = set.region;
        backing.solid = !is_shell(set.type);
        if (is_shell(set.type)) {
          behind[f].shells.push_back({normalised(area_vector(mesh, nodes)), thickness});
        }
      }
    }
  }
  std::ranges::for_each(behind, prefer_faces);
  std::ranges::for_each(behind, prefer_solids);
  return behind;
}

}  // namespace pounding::interactions
