#include "system/element_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <utility>

#include "common/dense_matrix.h"
#include "common/parallel.h"
#include "elements/measured_costs.h"
#include "mesh/location.h"
#include "stiffness/element_loop.h"
#include "system/mass_scaling.h"
#include "system/slivers.h"

namespace pounding {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Rounded to single precision, so that equal shapes at different places share a key; the frequency
/// of a class is good to about 1e-7.
std::string shape_key(std::span<const double> stiffness, std::span<const double> mass) {
  std::string key;
  double scale = 0;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    scale = std::max(scale, stiffness[i * mass.size() + i]);
  }
  const auto append = [&key](double value) {
    const auto rounded = static_cast<float>(value);
    char bytes[sizeof rounded];
    std::memcpy(bytes, &rounded, sizeof rounded);
    key.append(bytes, sizeof rounded);
  };
  append(scale);
  for (std::size_t i = 0; i < mass.size(); ++i) {
    append(stiffness[i * mass.size() + i]);
    append(stiffness[i]);
    append(mass[i]);
  }
  return key;
}

/// Steps that are compared: a geometric series from the present one to a thousand times it.
constexpr int candidates = 142;
constexpr double ratio = 1.05;

double cluster_node(const ElementTraits& traits) {
  switch (traits.family) {
    case ElementFamily::solid:
      return measured_costs::cluster_node_of_solids;
    case ElementFamily::shell:
      return measured_costs::cluster_node_of_shells;
    default:
      return measured_costs::cluster_node;
  }
}

/// Cost of the steps of a structure by the step that its mass is scaled for: of fewer steps, each
/// of which solves for the mass of more nodes. From the steps that single elements allow and the
/// costs of measured_costs.h.
class StepCosts {
 public:
  /// `mesh` must outlive this object.
  explicit StepCosts(const Mesh& mesh)
      : mesh_(mesh),
        shortest_(std::numeric_limits<double>::infinity()),
        longest_(shortest_),
        node_step_(static_cast<std::size_t>(mesh.owned_nodes), shortest_),
        node_cost_(node_step_.size(), 0.0) {}

  /// Every element of this rank, with the step that it allows by itself [s], infinite where it
  /// limits none.
  void add(const ElementBlock& block, std::size_t element, double step) {
    const ElementTraits& traits = traits_of(block.type);
    const auto width = static_cast<std::size_t>(traits.layout.nodes);
    shortest_ = std::min(shortest_, step);
    if (!traits.scalable) longest_ = std::min(longest_, step);
    if (holding_part(block.type) < 1) steps_.push_back(step);
    plain_ += block.counted[element] * traits.cost;
    for (std::size_t a = 0; a < width; ++a) {
      const auto node = static_cast<std::size_t>(block.connectivity[element * width + a]);
      if (node >= node_step_.size() || mesh_.free_components[node] == 0) continue;
      const double scaled_from = step / holding_part(block.type);
      if (scaled_from >= node_step_[node]) continue;
      node_step_[node] = scaled_from;
      node_cost_[node] = cluster_node(traits);
    }
  }

  /// Step, `most` [s] at most, at which an earthquake costs least, the cost of such a step and the
  /// share of coupled dofs, after every element; 0 where none costs less than the present one.
  /// Collective.
  ScalingOffer cheapest(double most) const {
    std::array<double, 2> limits{shortest_, std::min(most, longest_)};
    reduce_over_ranks(mesh_.comm, MPI_MIN, limits);
    const auto [shortest, longest] = limits;
    if (!std::isfinite(shortest)) return {};
    const auto candidate = [&](std::size_t k) {
      const double step = shortest * std::pow(ratio, static_cast<double>(k));
      const double unit = std::pow(10.0, std::floor(std::log10(step)) - 2);  // three digits
      return std::floor(step / unit) * unit;
    };
    // Cost and dofs of the nodes that each candidate is the first to scale, and the cost of a step.
    std::array<double, 2 * candidates + 1> sums{};
    sums.back() = plain_;
    for (std::size_t n = 0; n < node_step_.size(); ++n) {
      const double place = std::floor(std::log(node_step_[n] / shortest) / std::log(ratio)) + 1;
      if (place >= candidates) continue;
      const auto k = static_cast<std::size_t>(std::max(place, 0.0));
      sums[2 * k] += node_cost_[n];
      sums[2 * k + 1] += component_count(mesh_.free_components[n]);
    }
    reduce_over_ranks(mesh_.comm, MPI_SUM, sums);
    // Steps that each candidate is sure to allow.
    std::vector<double> steps = steps_;
    std::ranges::sort(steps);
    std::array<double, candidates> allowed{};
    for (std::size_t k = 0; k < candidates; ++k) {
      const double step = candidate(k);
      const auto left = std::ranges::lower_bound(steps, holding_part_of_meshes * step);
      allowed[k] = left == steps.end() ? step : std::min(step, *left);
    }
    reduce_over_ranks(mesh_.comm, MPI_MIN, allowed);
    ScalingOffer best;
    double gain = 1;
    double cost = 0;
    double dofs = 0;
    for (std::size_t k = 0; k < candidates && candidate(k) <= longest; ++k) {
      cost += sums[2 * k];
      dofs += sums[2 * k + 1];
      const double here = allowed[k] / shortest / (1 + cost / sums.back());
      if (here <= gain) continue;
      gain = here;
      best.time_step = candidate(k);
      best.allowed = allowed[k];
      best.cost = 1 + cost / sums.back();
      best.share = dofs / static_cast<double>(mesh_.global_dofs);
    }
    return best;
  }

 private:
  const Mesh& mesh_;
  double shortest_;                ///< step of all elements [s]
  double longest_;                 ///< that elements without scaled mass allow [s]
  double plain_ = 0;               ///< cost of a step without scaled mass
  std::vector<double> steps_;      ///< of shells and solids [s]
  std::vector<double> node_step_;  ///< from which an element at each owned node is scaled [s]
  std::vector<double> node_cost_;  ///< of its part in a solution, by that element
};

}  // namespace

double ElementBounds::frequency(std::span<const double> stiffness, std::span<const double> mass) {
  const std::string key = shape_key(stiffness, mass);
  const auto found = known_.find(key);
  if (found != known_.end()) return found->second;
  const double value = std::sqrt(std::max(0.0, largest_eigenvalue(stiffness, mass)));
  if (known_.size() < 100000) known_[key] = value;
  return value;
}

void ElementBounds::add(const ElementBlock& block, std::span<const double> stiffness,
                        std::span<const double> mass, std::span<const LocalIndex> dofs,
                        double mass_scaling) {
  mass_scaling_.push_back(mass_scaling);
  const bool has_mass = *std::max_element(mass.begin(), mass.end()) > 0;
  if (has_mass && !holds_massless(stiffness, mass)) {
    frequencies_.push_back(frequency(stiffness, mass));
    return;
  }
  const bool strains = std::ranges::any_of(stiffness, [](double k) { return k != 0; });
  frequencies_.push_back(strains ? infinity : -infinity);  // a dashpot bounds nothing
  if (mass_scaling > 0) {
    return;  // not without mass any more
  }
  device_damping_.resize(mesh_.owned_dofs);
  device_stiffness_.resize(device_damping_.size());
  const double beta = damping_of(block).beta;
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    if (dofs[i] < 0 || dofs[i] >= mesh_.owned_dofs) continue;
    for (std::size_t j = 0; j < dofs.size(); ++j) {
      if (dofs[j] >= 0) {
        const double k = stiffness[i * dofs.size() + j];
        device_stiffness_[dofs[i]] += std::abs(k);
        device_damping_[dofs[i]] += std::abs(beta * k);
      }
    }
  }
}

void ElementBounds::finish(LinearSystem& system) {
  system.element_frequency_bound = 0;
  system.element_time_step_bound = infinity;
  double named_frequency = 0;
  double named_step = infinity;
  auto frequency = frequencies_.begin();
  auto factor = mass_scaling_.begin();
  std::vector<std::vector<double>>
      all;  // steps that the elements of each block allow without devices
  for (const ElementBlock& block : mesh_.blocks) {
    std::vector<double>& alone = all.emplace_back();
    for (std::size_t e = 0; e < block.count(); ++e, ++frequency, ++factor) {
      // omega^2 / (1 + c omega^2)
      const double scaled =
          *factor > 0 ? 1 / std::sqrt(1 / (*frequency * *frequency) + *factor) : *frequency;
      const bool moves = !is_in_rigid_body(mesh_, block, e);  // as its stiffness and mass say
      system.element_frequency_bound = std::max(system.element_frequency_bound, scaled);
      if (moves && scaled < infinity && scaled > named_frequency) {
        named_frequency = scaled;
        system.stiffest_element = describe_element(mesh_, block, e);
      }
      const double dt = time_step(block, e, *frequency, *factor, system.lumped_mass);
      system.element_time_step_bound = std::min(system.element_time_step_bound, dt);
      if (moves && dt < named_step) {
        named_step = dt;
        system.limiting_element = describe_element(mesh_, block, e);
      }
      alone.push_back(time_step_alone(block, *frequency, *factor));
    }
    if (auto sliver = find_sliver(mesh_, block, alone)) {
      system.slivers.push_back(std::move(*sliver));
    }
  }
  if (structure_.mass_scaling == 0 && !structure_.step_target) {
    system.scaling_offer = find_offer(all);
  }
  share_extreme(mesh_.comm, MPI_MAXLOC, named_frequency, system.stiffest_element);
  share_extreme(mesh_.comm, MPI_MINLOC, named_step, system.limiting_element);
  reduce_over_ranks(mesh_.comm, MPI_MAX, system.element_frequency_bound);
  reduce_over_ranks(mesh_.comm, MPI_MIN, system.element_time_step_bound);
}

ScalingOffer ElementBounds::find_offer(const std::vector<std::vector<double>>& alone) const {
  StepCosts costs(mesh_);
  for (std::size_t b = 0; b < alone.size(); ++b) {
    for (std::size_t e = 0; e < alone[b].size(); ++e) costs.add(mesh_.blocks[b], e, alone[b][e]);
  }
  ScalingOffer offer = costs.cheapest(longest_scaled_step(structure_.damping, stiffening_));
  std::string last;  // group that was named
  for (std::size_t b = 0; offer.time_step > 0 && b < alone.size(); ++b) {
    const ElementBlock& block = mesh_.blocks[b];
    GlobalIndex count = 0;
    for (std::size_t e = 0; traits_of(block.type).scalable && e < alone[b].size(); ++e) {
      count += alone[b][e] < holding_part(block.type) * offer.time_step ? block.counted[e] : 0;
    }
    reduce_over_ranks(mesh_.comm, MPI_SUM, count);
    if (count > 0 && block.group != last) {
      offer.groups += (last.empty() ? "" : ", ") + block.group;
      last = block.group;
    }
    offer.elements += count;
  }
  return offer;
}

double ElementBounds::time_step_alone(const ElementBlock& block, double frequency,
                                      double mass_scaling) const {
  if (mass_scaling > 0) return structure_.mass_scaling;
  if (std::isinf(frequency)) {
    return infinity;  // without mass: the others carry it
  }
  const Rayleigh damping = damping_of(block);
  const double square = frequency * frequency;
  return critical_time_step(damping.alpha + damping.beta * square, stiffening_ * square);
}

/// Time step of an element with the springs at its owned dofs; other ranks that hold it see to the
/// rest.
double ElementBounds::time_step(const ElementBlock& block, std::size_t element, double frequency,
                                double mass_scaling, std::span<const double> lumped_mass) const {
  double smallest = time_step_alone(block, frequency, mass_scaling);
  if (mass_scaling > 0 || std::isinf(frequency) || device_damping_.empty()) return smallest;
  const Rayleigh damping = damping_of(block);
  const double square = frequency * frequency;
  const double rate = damping.alpha + damping.beta * square;
  for (const LocalIndex dof : stiffness::ElementDofs(mesh_, block, element)) {
    // A dof without mass follows others, which carry the forces on it.
    if (dof >= 0 && dof < mesh_.owned_dofs && lumped_mass[dof] > 0) {
      smallest = std::min(
          smallest,
          critical_time_step(rate + device_damping_[dof] / lumped_mass[dof],
                             stiffening_ * (square + device_stiffness_[dof] / lumped_mass[dof])));
    }
  }
  return smallest;
}

Rayleigh ElementBounds::damping_of(const ElementBlock& block) const {
  return structure_.damping_of(structure_.regions[block.region]);
}

}  // namespace pounding
