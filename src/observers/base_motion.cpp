#include "observers/base_motion.h"

namespace pounding {

DisplacementSum::DisplacementSum(std::size_t structure, std::span<const TracePoint> points,
                                 std::span<const double> weights, const LinearSystem& system,
                                 const Mesh& mesh)
    : structure_(structure) {
  const Trace trace(system, mesh, points, false);
  dofs_ = trace.dofs();
  weights_.resize(dofs_.size());
  std::size_t free = 0;  // points of a mesh that are not clamped
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (std::size_t i = 0; system.generalised && i < dofs_.size(); ++i) {
      weights_[i] += weights[k] * trace.row(k)[i];
    }
    if (!system.generalised && trace.dof(k) >= 0) weights_[free++] = weights[k];
    const std::span<const double> carried = trace.carried(k);
    carried_.resize(carried.size());
    for (std::size_t c = 0; c < carried.size(); ++c) carried_[c] += weights[k] * carried[c];
  }
  if (system.switched) in_modes_ = system.switched->weighted(dofs_, weights_);
}

double DisplacementSum::of(const CdLagrange& stepper) const {
  const State& state = stepper.state();
  const std::vector<double>& owned = state.structures[structure_].displacement;
  const SwitchedRun* const run = stepper.in_modes(structure_);
  double sum = 0;
  for (std::size_t j = 0; run && j < in_modes_.size(); ++j) {
    sum += in_modes_[j] * run->coordinates()[j];
  }
  for (std::size_t i = 0; !run && i < dofs_.size(); ++i) sum += weights_[i] * owned[dofs_[i]];
  for (std::size_t c = 0; c < carried_.size(); ++c) {
    sum += carried_[c] * state.supports.displacement[c];
  }
  return sum;
}

BaseMotion::BaseMotion(std::span<const ResolvedProbe> bases, std::span<const LinearSystem> systems,
                       std::span<const Mesh> meshes) {
  for (const ResolvedProbe& base : bases) {
    const auto s = static_cast<std::size_t>(base.structure);
    for (int d = 0; d < 3; ++d) {
      std::vector<TracePoint> places;
      for (const GlobalIndex node : base.nodes) {
        if (meshes[s].owned_node(node) >= 0) places.push_back({node, d});
      }
      const std::vector<double> shares(places.size(), 1 / static_cast<double>(base.nodes.size()));
      rows_.emplace_back(s, places, shares, systems[s], meshes[s]);
    }
  }
}

void BaseMotion::put(const CdLagrange& stepper, double* out) const {
  for (const DisplacementSum& row : rows_) *out++ = row.of(stepper);
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

}  // namespace pounding
