#include "observers/base_motion.h"

#include <numeric>

namespace pounding {
BaseMotion::BaseMotion(std::span<const ResolvedProbe> bases, std::span<const LinearSystem> systems,
                       std::span<const Mesh> meshes) {
  for (const ResolvedProbe& base : bases) {
    const auto s = static_cast<std::size_t>(base.structure);
    const LinearSystem& system = systems[s];
    const double share = 1 / static_cast<double>(base.nodes.size());
    for (int d = 0; d < 3; ++d) {
      std::vector<TracePoint> places;
      for (const GlobalIndex node : base.nodes) {
        if (meshes[s].owned_node(node) >= 0) places.push_back({node, d});
      }
      const Trace trace(system, meshes[s], places, false);
      Row& row = rows_.emplace_back();
      row.structure = s;
      row.dofs = trace.dofs();
      row.weights.assign(row.dofs.size(), system.generalised ? 0 : share);
      for (std::size_t k = 0; k < places.size(); ++k) {
        for (std::size_t i = 0; system.generalised && i < row.dofs.size(); ++i) {
          row.weights[i] += share * trace.row(k)[i];
        }
        const std::span<const double> carried = trace.carried(k);
        row.carried.resize(carried.size());
        for (std::size_t c = 0; c < carried.size(); ++c) row.carried[c] += share * carried[c];
      }
      if (system.switched) row.in_modes = system.switched->weighted(row.dofs, row.weights);
    }
  }
}

std::vector<double> probe_means(
    std::span<const ResolvedProbe* const> probes,
    const std::function<std::span<const double>(std::size_t place)>& row_of) {
  const std::size_t width = probes.empty() ? 0 : row_of(0).size();
  std::vector<double> rows(3 * probes.size() * width, 0.0);
  std::size_t place = 0;
  for (std::size_t p = 0; p < probes.size(); ++p) {
    const std::size_t nodes = probes[p]->nodes.size();
    for (std::size_t k = 0; k < 9 * nodes; ++k) {
      const double weight = probes[p]->weight(k / 9, k / 3 % 3)[k % 3];
      const std::span<const double> row = row_of(place + k / 9 * 3 + k % 3);
      for (std::size_t i = 0; weight != 0 && i < width; ++i) {
        rows[(3 * p + k / 3 % 3) * width + i] += weight * row[i] / static_cast<double>(nodes);
      }
    }
    place += 3 * nodes;
  }
  return rows;
}

void BaseMotion::put(const CdLagrange& stepper, double* out) const {
  const State& state = stepper.state();
  for (const Row& row : rows_) {
    const std::vector<double>& owned = state.structures[row.structure].displacement;
    const std::span<const double> q = stepper.coordinates(row.structure);
    double sum = std::inner_product(q.begin(), q.end(), row.in_modes.begin(), 0.0);
    for (std::size_t i = 0; q.empty() && i < row.dofs.size(); ++i) {
      sum += row.weights[i] * owned[row.dofs[i]];
    }
    for (std::size_t c = 0; c < row.carried.size(); ++c) {
      sum += row.carried[c] * state.supports.displacement[c];
    }
    *out++ = sum;
  }
}

}  // namespace pounding
