#include "system/mass_scaling.h"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "common/dense_matrix.h"
#include "common/error.h"
#include "common/facts.h"
#include "common/integer_sets.h"
#include "elements/element_traits.h"
#include "laws/law_of.h"
#include "mesh/element_properties.h"
#include "stiffness/single_stiffness.h"
#include "system/block_factorisation.h"

namespace pounding {
namespace {

[[noreturn]] void refuse(const Structure& structure, const std::string& why) {
  throw UserError(
      sentence("option -{}_{} {} s: {}",
               {structure.name, structure.step_target ? "time_step_target" : "mass_scaling",
                structure.mass_scaling, why}));
}

void check_alpha(const Structure& structure, const Region& region) {
  const double alpha = structure.damping_of(region).alpha;
  if (structure.mass_scaling * alpha >= 2) {
    refuse(structure, sentence("the damping alpha = {} 1/s of group {} allows no step above {} s; "
                               "ask for a smaller one",
                               {alpha, region.group, 2 / alpha}));
  }
}

/// Nodes of the whole mesh that one rank must own together.
class Couplings {
 public:
  explicit Couplings(const GlobalMesh& mesh)
      : mesh_(mesh),
        groups_(static_cast<std::size_t>(mesh.node_count())),
        coupled_(static_cast<std::size_t>(mesh.node_count()), 0),
        scaled_(coupled_) {}

  /// Clamped nodes connect nothing.
  void join(std::span<const GlobalIndex> nodes, bool scaled) {
    GlobalIndex first = -1;
    for (const GlobalIndex node : nodes) {
      const std::size_t n = node;
      if (!is_free(node)) continue;
      coupled_[n] = 1;
      scaled_[n] = scaled || scaled_[n] != 0;
      if (first < 0) first = node;
      groups_.join(static_cast<std::size_t>(first), n);
    }
    for (std::size_t a = 0; scaled && a < nodes.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        if (is_free(nodes[a]) && is_free(nodes[b])) edges_.push_back({nodes[a], nodes[b]});
      }
    }
  }

  struct Group {
    NodeCluster cluster;
    GlobalIndex scaled_dofs = 0;
    std::vector<std::array<GlobalIndex, 2>> edges;  ///< of nodes that S couples
  };
  std::map<std::size_t, Group> groups() {
    std::map<std::size_t, Group> result;
    for (std::size_t n = 0; n < coupled_.size(); ++n) {
      if (coupled_[n] != 0) {
        Group& group = result[groups_.root(n)];
        group.cluster.nodes.push_back(static_cast<GlobalIndex>(n));
        group.scaled_dofs += scaled_[n] != 0 ? component_count(mesh_.free_components[n]) : 0;
      }
    }
    for (const auto& edge : edges_) {
      result[groups_.root(static_cast<std::size_t>(edge[0]))].edges.push_back(edge);
    }
    return result;
  }

 private:
  bool is_free(GlobalIndex node) const {
    return mesh_.free_components[static_cast<std::size_t>(node)] != 0;
  }

  const GlobalMesh& mesh_;
  DisjointSets groups_;
  std::vector<char> coupled_;
  std::vector<char> scaled_;
  std::vector<std::array<GlobalIndex, 2>> edges_;
};

/// Whether the factor of M + S of a group is too large.
bool fills_in(const Couplings::Group& group, std::size_t most_blocks) {
  const std::vector<GlobalIndex>& nodes = group.cluster.nodes;  // increasing
  const auto place = [&](GlobalIndex node) {
    return static_cast<int>(std::ranges::lower_bound(nodes, node) - nodes.begin());
  };
  std::vector<std::set<int>> neighbours(nodes.size());
  for (const auto& [a, b] : group.edges) {
    neighbours[static_cast<std::size_t>(place(a))].insert(place(b));
    neighbours[static_cast<std::size_t>(place(b))].insert(place(a));
  }
  return !eliminate(std::move(neighbours), most_blocks);
}

/// Largest row sum of |K_e| over the mass [1/s2], which no omega_e^2 exceeds; infinite where a dof
/// that the element holds gets no mass from it.
double row_bound(std::span<const double> stiffness, std::span<const double> lumped_mass) {
  const std::size_t n = lumped_mass.size();
  double bound = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) sum += std::abs(stiffness[i * n + j]);
    if (sum > 0) bound = std::max(bound, sum / std::max(lumped_mass[i], 0.0));
  }
  return bound;
}

/// Whether an element of the whole mesh is scaled.
class Decision {
 public:
  Decision(const Structure& structure, const GlobalMesh& mesh)
      : structure_(structure), mesh_(mesh) {}

  bool scales(const ElementSet& set, std::size_t element, std::span<const GlobalIndex> nodes) {
    const Region& region = structure_.regions[set.region];
    const ElementProperties properties = element_properties(region, set.share_of(element));
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const Vector3 x = mesh_.position(nodes[a]);
      std::copy(x.begin(), x.end(), &coordinates_[3 * a]);
    }
    const std::size_t size = element_layout(set.type).size();
    const std::span<double> stiffness(stiffness_.data(), size * size);
    const std::span<double> mass(mass_.data(), size);
    try {
      stiffness::element_matrices_in(structure_.numbers, set.type,
                                     {coordinates_.data(), 3 * nodes.size()}, properties, stiffness,
                                     mass);
    } catch (const ElementError&) {
      return false;  // the assembly names it
    }
    return add_element_mass(structure_.mass_scaling, structure_.damping_of(region), stiffness, mass,
                            {added_.data(), size * size}, structure_.stiffening(),
                            holding_part(set.type)) > 0;
  }

 private:
  using Matrix = std::array<double, max_element_size * max_element_size>;
  const Structure& structure_;
  const GlobalMesh& mesh_;
  std::array<double, 3 * max_element_nodes> coordinates_{};
  std::array<double, max_element_size> mass_{};
  Matrix stiffness_{};
  Matrix added_{};
};

}  // namespace

double mass_scaling_factor(double time_step, const Rayleigh& damping, double frequency,
                           double stiffening) {
  const double needed = time_step / 4 * (2 * damping.beta + stiffening * time_step);
  return std::max(0.0, needed - (1 - time_step * damping.alpha / 2) / (frequency * frequency));
}

double longest_scaled_step(const Rayleigh& damping, double stiffening) {
  constexpr double allowed = 0.01;
  constexpr double circular_frequency = 2 * std::numbers::pi * 400;
  const double factor = 2 * allowed / (circular_frequency * circular_frequency);
  const double beta = damping.beta;
  return 4 * factor / (beta + std::sqrt(beta * beta + 4 * stiffening * factor));
}

bool may_scale(const Structure& structure, ElementType type) {
  const ElementTraits& traits = traits_of(type);
  return structure.mass_scaling > 0 && traits.scalable &&
         (!structure.step_target || traits.layout.nodes <= 2);
}

double holding_part(ElementType type) {
  return traits_of(type).layout.nodes <= 2 ? 1 : holding_part_of_meshes;
}

bool holds_massless(std::span<const double> stiffness, std::span<const double> lumped_mass) {
  const std::size_t n = lumped_mass.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (!(lumped_mass[i] > 0) && stiffness[i * n + i] != 0) return true;
  }
  return false;
}

double add_element_mass(double time_step, const Rayleigh& damping,
                        std::span<const double> stiffness, std::span<const double> lumped_mass,
                        std::span<double> added, double stiffening, double part) {
  const auto factor_for = [&](double step, double square) {
    return mass_scaling_factor(step, damping, std::sqrt(square), stiffening);
  };
  const double bound = row_bound(stiffness, lumped_mass);
  if (factor_for(part * time_step, bound) == 0) return 0;
  const double square = std::isinf(bound) ? bound : largest_eigenvalue(stiffness, lumped_mass);
  if (factor_for(part * time_step, square) == 0) return 0;
  const double factor = factor_for(time_step, square);
  for (std::size_t i = 0; i < added.size(); ++i) added[i] += factor * stiffness[i];
  return factor;
}

std::vector<NodeCluster> coupled_nodes(const Structure& structure, const GlobalMesh& mesh,
                                       int structure_number, std::size_t most_blocks) {
  Couplings couplings(mesh);
  Decision decision(structure, mesh);
  for (const Region& region : structure.regions) check_alpha(structure, region);
  std::vector<char> rigid(static_cast<std::size_t>(mesh.node_count()), 0);
  for (const RigidNodes& part : mesh.rigid) {
    couplings.join(part.nodes, false);
    for (const GlobalIndex node : part.nodes) rigid[node] = 1;
  }
  for (const WaterBody& water : mesh.water) couplings.join(water.nodes, false);
  const auto meets_rigid = [&](std::span<const GlobalIndex> nodes) {
    return std::ranges::any_of(nodes, [&](GlobalIndex node) { return rigid[node] != 0; });
  };
  for (const ElementSet& set : mesh.regions) {
    const std::size_t width = element_layout(set.type).nodes;
    const bool links = width == 2 && interactions::has_links(structure.regions[set.region]);
    const bool scalable = is_in_stiffness(set.type) && may_scale(structure, set.type);
    const bool looked_at = links || scalable;
    for (std::size_t e = 0; looked_at && e < set.tags.size(); ++e) {
      const std::span<const GlobalIndex> nodes(&set.connectivity[e * width], width);
      const bool scaled = scalable && !meets_rigid(nodes) && decision.scales(set, e, nodes);
      if (links || scaled) couplings.join(nodes, scaled);
    }
  }
  std::vector<NodeCluster> result;
  for (auto& [root, group] : couplings.groups()) {
    if (fills_in(group, most_blocks)) {
      refuse(structure, "it couples " + std::to_string(group.scaled_dofs) +
                            " dofs with each other, and the factor of their mass has more than " +
                            std::to_string(most_blocks) +
                            " blocks of 6 x 6; ask for a smaller step");
    }
    group.cluster.structure = structure_number;
    result.push_back(std::move(group.cluster));
  }
  return result;
}

}  // namespace pounding
