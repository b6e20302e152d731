#include "system/step_costs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "elements/measured_costs.h"

namespace pounding {
namespace {

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

}  // namespace

StepCosts::StepCosts(const Mesh& mesh)
    : mesh_(mesh),
      shortest_(std::numeric_limits<double>::infinity()),
      longest_(shortest_),
      node_step_(static_cast<std::size_t>(mesh.owned_nodes), shortest_),
      node_cost_(node_step_.size(), 0.0) {}

void StepCosts::add(const ElementBlock& block, std::size_t element, double step) {
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

ScalingOffer StepCosts::cheapest(double most) const {
  std::array<double, 2> limits{shortest_, std::min(most, longest_)};
  MPI_Allreduce(MPI_IN_PLACE, limits.data(), 2, MPI_DOUBLE, MPI_MIN, mesh_.comm);
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
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                mesh_.comm);
  // Steps that each candidate is sure to allow.
  std::vector<double> steps = steps_;
  std::ranges::sort(steps);
  std::array<double, candidates> allowed{};
  for (std::size_t k = 0; k < candidates; ++k) {
    const double step = candidate(k);
    const auto left = std::ranges::lower_bound(steps, holding_part_of_meshes * step);
    allowed[k] = left == steps.end() ? step : std::min(step, *left);
  }
  MPI_Allreduce(MPI_IN_PLACE, allowed.data(), candidates, MPI_DOUBLE, MPI_MIN, mesh_.comm);
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

}  // namespace pounding
