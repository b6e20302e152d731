#include "mesh/divide_beams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "common/error.h"
#include "common/matrix3.h"
#include "elements/beam2.h"
#include "mesh/element_properties.h"

namespace pounding {
namespace {

constexpr int line_type = 1;  // Gmsh's
constexpr double most_parts = 1000;

using Edge = std::pair<std::int64_t, std::int64_t>;

Edge edge_of(std::int64_t a, std::int64_t b) {
  return {std::min(a, b), std::max(a, b)};
}

/// Edges of triangles and quadrangles.
std::set<Edge> edges_of_surfaces(const RawMesh& mesh) {
  std::set<Edge> edges;
  for (const RawEntity& entity : mesh.entities) {
    if (entity.dimension != 2) continue;
    for (const RawElements& part : entity.elements) {
      const std::size_t width = part.nodes.size() / std::max<std::size_t>(1, part.tags.size());
      for (std::size_t i = 0; i < part.nodes.size(); ++i) {
        const std::size_t first = i - i % width;
        edges.insert(edge_of(part.nodes[i], part.nodes[first + (i + 1 - first) % width]));
      }
    }
  }
  return edges;
}

class BeamDivider {
 public:
  BeamDivider(const Structure& structure, RawMesh& mesh, int splits)
      : structure_(structure), mesh_(mesh), splits_(splits), edges_(edges_of_surfaces(mesh)) {
    for (std::size_t i = 0; i < mesh_.node_tags.size(); ++i) places_[mesh_.node_tags[i]] = i;
    if (!places_.empty()) last_node_ = places_.rbegin()->first;
    for (const RawEntity& entity : mesh_.entities) {
      for (const RawElements& part : entity.elements) {
        for (const std::int64_t tag : part.tags) last_element_ = std::max(last_element_, tag);
      }
    }
  }

  std::vector<DividedLines> divide() {
    std::vector<DividedLines> divided;
    for (const Region& region : structure_.regions) {
      if (!is_beam(region.element) || region.parts == 1) continue;
      DividedLines& lines = divided.emplace_back();
      lines.group = region.group;
      for (RawEntity& entity : mesh_.entities) {
        if (!is_of(region, entity)) continue;
        for (RawElements& part : entity.elements) {
          if (part.type == line_type) cut(region, is_of_others(region, entity), part, lines);
        }
      }
    }
    for (RawEntity& entity : mesh_.entities) {
      const auto has = [&](const Region& region) { return is_of(region, entity); };
      if (std::ranges::any_of(structure_.regions, has)) continue;
      for (RawElements& part : entity.elements) {
        if (part.type == line_type) follow(part);
      }
    }
    return divided;
  }

 private:
  bool is_of(const Region& region, const RawEntity& entity) const {
    return entity.dimension == 1 && std::ranges::any_of(mesh_.groups, [&](const RawGroup& group) {
             return group.dimension == 1 && group.name == region.group &&
                    std::ranges::find(group.entities, entity.tag) != group.entities.end();
           });
  }

  bool is_of_others(const Region& region, const RawEntity& entity) const {
    return std::ranges::any_of(structure_.regions, [&](const Region& other) {
      return other.group != region.group && is_of(other, entity);
    });
  }

  Vector3 position(std::int64_t node) const {
    const double* x = &mesh_.coordinates[3 * places_.at(node)];
    return {x[0], x[1], x[2]};
  }

  std::size_t parts_of(const Region& region, std::int64_t first, std::int64_t last) const {
    if (region.parts > 0) return static_cast<std::size_t>(region.parts);
    const double length = norm(minus(position(last), position(first)));
    const double beams = std::ldexp(beams_per_half_wave, splits_);
    const double parts = std::ceil(beams * length / half_wave_of(region));
    refuse_if(!(parts <= most_parts),
              "option -" + structure_.name + "_" + region.group +
                  "_divide auto: a line would become more than a thousand beams up to the "
                  "highest of -spectra_frequencies; lower that, or give a count");
    return std::max<std::size_t>(1, static_cast<std::size_t>(parts));
  }

  static double half_wave_of(const Region& region) {
    return half_wave(element_properties(region), region.resolved_frequency);
  }

  std::int64_t add_node(const Vector3& x) {
    mesh_.node_tags.push_back(++last_node_);
    mesh_.coordinates.insert(mesh_.coordinates.end(), x.begin(), x.end());
    return last_node_;
  }

  void cut(const Region& region, bool shared, RawElements& part, DividedLines& lines) {
    RawElements cut;
    cut.type = part.type;
    const auto add = [&](std::int64_t tag, std::int64_t from, std::int64_t to) {
      cut.tags.push_back(tag);
      cut.nodes.insert(cut.nodes.end(), {from, to});
    };
    for (std::size_t e = 0; e < part.tags.size(); ++e) {
      const std::int64_t first = part.nodes[2 * e];
      const std::int64_t last = part.nodes[2 * e + 1];
      const bool whole = shared || edges_.contains(edge_of(first, last));
      const std::size_t count = whole ? 1 : parts_of(region, first, last);
      std::vector<std::int64_t> chain{first};
      for (std::size_t i = 1; i <= count; ++i) {
        const std::int64_t tag = i == 1 ? part.tags[e] : ++last_element_;
        const std::int64_t to = i == count ? last : add_node(between(first, last, i, count));
        add(tag, chain.back(), to);
        chain.push_back(to);
      }
      if (count > 1) chains_.emplace(edge_of(first, last), std::move(chain));
      ++lines.lines;
      lines.beams += static_cast<GlobalIndex>(count);
      lines.whole += whole ? 1 : 0;
    }
    part = std::move(cut);
  }

  /// Lines that no elements are made of, of loads, clamps, ties, contacts, probes, get the nodes of
  /// the beams on them.
  void follow(RawElements& part) {
    RawElements cut;
    cut.type = part.type;
    for (std::size_t e = 0; e < part.tags.size(); ++e) {
      const std::array<std::int64_t, 2> ends{part.nodes[2 * e], part.nodes[2 * e + 1]};
      const auto found = chains_.find(edge_of(ends[0], ends[1]));
      std::vector<std::int64_t> chain(ends.begin(), ends.end());
      if (found != chains_.end()) chain = found->second;
      if (chain.front() != ends[0]) std::ranges::reverse(chain);
      for (std::size_t i = 1; i < chain.size(); ++i) {
        cut.tags.push_back(i == 1 ? part.tags[e] : ++last_element_);
        cut.nodes.insert(cut.nodes.end(), {chain[i - 1], chain[i]});
      }
    }
    part = std::move(cut);
  }

  Vector3 between(std::int64_t first, std::int64_t last, std::size_t i, std::size_t count) const {
    const double share = static_cast<double>(i) / static_cast<double>(count);
    const Vector3 a = position(first);
    const Vector3 b = position(last);
    return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]),
            a[2] + share * (b[2] - a[2])};
  }

  const Structure& structure_;
  RawMesh& mesh_;
  int splits_;
  const std::set<Edge> edges_;
  std::map<std::int64_t, std::size_t> places_;        ///< of the nodes of the file, by tag
  std::map<Edge, std::vector<std::int64_t>> chains_;  ///< nodes of the beams that lines became
  std::int64_t last_node_ = 0;
  std::int64_t last_element_ = 0;
};

}  // namespace

std::vector<DividedLines> divide_beams(const Structure& structure, RawMesh& mesh, int splits) {
  const bool asked = std::ranges::any_of(structure.regions, [](const Region& region) {
    return is_beam(region.element) && region.parts != 1;
  });
  return asked ? BeamDivider(structure, mesh, splits).divide() : std::vector<DividedLines>{};
}

}  // namespace pounding
