#include "mesh/mesh_waves.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "elements/beam2.h"
#include "elements/flat_shell.h"
#include "mesh/element_properties.h"

namespace pounding {
namespace {

constexpr double elements_in_wave = 6;
constexpr double beams_in_wave = 4;
constexpr double part_of_span = 0.4;  ///< of the frequency of half a wave in one element
constexpr double coarse_part = 0.1;   ///< of the mass, in elements that carry less
constexpr int none = -1;              ///< region or body of a node
constexpr int several = -2;           ///< likewise, more than one

/// Marks of a node by the elements and bodies around it.
struct Surroundings {
  int region = none;
  int body = none;           ///< that is rigid
  std::uint64_t solids = 0;  ///< a number for each set of solids
};

class WaveFinder {
 public:
  WaveFinder(const Structure& structure, const GlobalMesh& mesh)
      : structure_(structure), mesh_(mesh), around_(mesh.node_tags.size()) {
    std::uint64_t number = 0;
    for (const ElementSet& set : mesh.regions) {
      if (!has_extent(set.type)) continue;
      for (std::size_t e = 0; e < set.tags.size(); ++e) {
        std::uint64_t mixed = ++number * 0x9e3779b97f4a7c15ULL;
        mixed = (mixed ^ mixed >> 30) * 0xbf58476d1ce4e5b9ULL;
        for (const GlobalIndex n : set.nodes_of(e)) {
          Surroundings& node = around(n);
          node.region = node.region == none || node.region == set.region ? set.region : several;
          if (is_solid(set.type)) node.solids += mixed ^ mixed >> 27;
        }
      }
    }
    for (std::size_t b = 0; b < mesh.rigid.size(); ++b) {
      for (const GlobalIndex n : mesh.rigid[b].nodes) {
        around(n).region = several;
        if (mesh.rigid[b].components == 0x3f) around(n).body = static_cast<int>(b);
      }
    }
  }

  MeshWaves find() {
    double total = 0;
    std::map<int, std::pair<double, MeshWaves>> by_frequency;  // by half a percent, with the mass
    for (const ElementSet& set : mesh_.regions) {
      for (std::size_t e = 0; e < set.tags.size(); ++e) {
        const auto region = static_cast<std::size_t>(set.region);
        const ElementProperties properties =
            element_properties(structure_.regions[region], set.share_of(e));
        const double mass = mass_of(set, e, properties);
        total += mass;
        if (!has_extent(set.type) || !(mass > 0) || is_rigid(set.nodes_of(e))) continue;
        const MeshWaves waves = carried(set, e, properties);
        if (!(waves.frequency > 0)) continue;  // a bar of its dashpot alone
        auto& [sum, first] = by_frequency[static_cast<int>(200 * std::log(waves.frequency))];
        if (sum == 0 || waves.frequency < first.frequency) first = waves;
        sum += mass;
      }
    }
    for (const auto& [step, of] : by_frequency) {
      total -= of.first / coarse_part;
      if (total <= 0) return of.second;
    }
    return {};
  }

 private:
  Surroundings& around(GlobalIndex n) { return around_[static_cast<std::size_t>(n)]; }
  const Surroundings& around(GlobalIndex n) const { return around_[static_cast<std::size_t>(n)]; }

  double mass_of(const ElementSet& set, std::size_t element, const ElementProperties& properties) {
    coordinates_.clear();
    for (const GlobalIndex n : set.nodes_of(element)) {
      const Vector3 at = mesh_.position(n);
      coordinates_.insert(coordinates_.end(), at.begin(), at.end());
    }
    const ElementLayout layout = element_layout(set.type);
    masses_.resize(static_cast<std::size_t>(layout.size()));
    try {
      element_lumped_mass(set.type, coordinates_, properties, masses_);
    } catch (const ElementError&) {
      return 0;  // refused with its place where its matrices are made
    }
    double mass = 0;
    for (int a = 0; a < layout.nodes; ++a) {
      mass += masses_[static_cast<std::size_t>(a * layout.components)];
    }
    return mass;
  }

  MeshWaves carried(const ElementSet& set, std::size_t element, const ElementProperties& p) const {
    const std::span nodes = set.nodes_of(element);
    auto [longest, thickness] = edges_of(set.type, nodes);
    double omega = 0;
    if (is_beam(set.type)) {
      const bool chords_turn = set.type == ElementType::euler_beam;
      omega = bending(p, chords_turn ? elements_in_wave : beams_in_wave, longest, nodes);
    } else if (is_bar(set.type)) {
      omega = stretch(p.young * p.area / (p.density * p.area + p.added_mass), longest);
    } else if (is_shell(set.type)) {
      omega = bending(strip(p, p.thickness), elements_in_wave, longest, nodes);
    } else {
      omega = stretch(p.young / (2 * (1 + p.poisson)) / p.density, longest);
      if (thickness < longest) {
        omega = std::min(omega, bending(strip(p, thickness), elements_in_wave, longest, nodes));
      }
    }
    return {omega / (2 * std::numbers::pi), longest, set.group};
  }

  /// The longest edge, and the shortest of those between two free faces, else 1e300 [m].
  std::pair<double, double> edges_of(ElementType type, std::span<const GlobalIndex> nodes) const {
    std::pair<double, double> edges{0, 1e300};
    const auto include = [&](GlobalIndex a, GlobalIndex b) {
      const double length = distance(mesh_.position(a), mesh_.position(b));
      edges.first = std::max(edges.first, length);
      if (around(a).solids == around(b).solids) edges.second = std::min(edges.second, length);
    };
    for (const ElementFace& face : traits_of(type).faces) {
      const std::span corners = face.corners();
      for (std::size_t i = 0; i < corners.size(); ++i) {
        include(nodes[corners[i]], nodes[corners[(i + 1) % corners.size()]]);
      }
    }
    for (std::size_t i = 0; !is_solid(type) && i < nodes.size(); ++i) {
      include(nodes[i], nodes[(i + 1) % nodes.size()]);
    }
    return edges;
  }

  static double stretch(double squared_speed, double size) {
    return 2 * std::numbers::pi * std::sqrt(squared_speed) / (elements_in_wave * size);
  }

  double bending(const ElementProperties& p, double in_wave, double size,
                 std::span<const GlobalIndex> nodes) const {
    const double omega = wave_frequency(p, in_wave / 2 * size);
    const bool spans =
        std::ranges::all_of(nodes, [&](GlobalIndex n) { return around(n).region == several; });
    return spans ? std::max(omega, part_of_span * wave_frequency(p, size)) : omega;
  }

  /// A plate of unit width.
  static ElementProperties strip(ElementProperties p, double thickness) {
    p.area = thickness;
    p.inertia_y = p.inertia_z = std::pow(thickness, 3) / 12 / (1 - p.poisson * p.poisson);
    p.shear_area_y = p.shear_area_z = shear_correction * thickness;
    return p;
  }

  bool is_rigid(std::span<const GlobalIndex> nodes) const {
    const int body = around(nodes[0]).body;
    return body != none &&
           std::ranges::all_of(nodes, [&](GlobalIndex n) { return around(n).body == body; });
  }

  const Structure& structure_;
  const GlobalMesh& mesh_;
  std::vector<Surroundings> around_;  ///< each node
  std::vector<double> coordinates_;   ///< of an element, and its lumped masses: room for work
  std::vector<double> masses_;
};

}  // namespace

MeshWaves mesh_waves(const Structure& structure, const GlobalMesh& mesh) {
  return structure.matrices.empty() ? WaveFinder(structure, mesh).find() : MeshWaves{};
}

}  // namespace pounding
