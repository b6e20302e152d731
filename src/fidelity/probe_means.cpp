#include "fidelity/probe_means.h"

#include <algorithm>

namespace pounding {

ProbeMeans::ProbeMeans(std::span<const ResolvedProbe> probes, std::span<const LinearSystem> systems,
                       std::span<const Mesh> meshes)
    : channels_(3 * probes.size()) {
  for (std::size_t s = 0; s < systems.size(); ++s) {
    std::vector<TracePoint> places;
    std::vector<std::size_t> channels;
    std::vector<double> weights;
    for (std::size_t p = 0; p < probes.size(); ++p) {
      for (const GlobalIndex node : probes[p].nodes) {
        if (probes[p].structure != static_cast<int>(s) || meshes[s].owned_node(node) < 0) continue;
        for (int d = 0; d < 3; ++d) {
          places.push_back({node, d});
          channels.push_back(3 * p + static_cast<std::size_t>(d));
          weights.push_back(1 / static_cast<double>(probes[p].nodes.size()));
        }
      }
    }
    std::vector<double> values(places.size());
    nodes_.push_back({s, Trace(systems[s], meshes[s], places, false), std::move(channels),
                      std::move(weights), std::move(values)});
  }
}

void ProbeMeans::velocities(const State& state, std::span<double> channels) {
  std::ranges::fill(channels, 0.0);
  for (Nodes& nodes : nodes_) {
    nodes.trace.apply(state.structures[nodes.structure].velocity.data(), nodes.values.data(), 1);
    for (std::size_t i = 0; i < nodes.values.size(); ++i) {
      channels[nodes.channels[i]] += nodes.weights[i] * nodes.values[i];
    }
  }
}

}  // namespace pounding
