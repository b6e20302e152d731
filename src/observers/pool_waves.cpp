#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "common/parallel.h"
#include "common/saved_state.h"
#include "observers/observed_run.h"
#include "observers/run_statistics.h"
#include "scene/pool_reader.h"
#include "system/trace.h"

namespace pounding {
namespace {

/// Height of the waves at the walls of a pool across a direction, over the dofs of this rank.
struct WaveRow {
  std::size_t structure = 0;
  std::vector<LocalIndex> dofs;
  std::vector<double> weights;  ///< of these
  std::vector<double> carried;  ///< of the supports' motion
};

/// Adds, per node of this rank, the springs of one wave: the node of the wave less the mean of the
/// walls, times the height of the wave per displacement.
void add_wave(const Mesh& mesh, int region, std::size_t direction, double height,
              std::map<TracePoint, double>& points) {
  for (const ElementBlock& block : mesh.blocks) {
    if (block.region != region) continue;
    for (std::size_t e = 0; e < block.count(); ++e) {
      for (const std::size_t end : {0, 1}) {
        const LocalIndex node = block.connectivity[2 * e + end];
        if (node >= mesh.owned_nodes) continue;
        points[{mesh.file_node[node], static_cast<int>(direction)}] +=
            (end == 0 ? height : -height) * block.share[e];
      }
    }
  }
}

WaveRow row_of(const Model& model, std::size_t structure,
               const std::map<TracePoint, double>& weights) {
  const LinearSystem& system = model.systems[structure];
  std::vector<TracePoint> points;
  for (const auto& [point, weight] : weights) points.push_back(point);
  const Trace trace(system, model.meshes[structure], points, false);
  WaveRow row{structure, {}, {}, {}};
  if (system.generalised) {
    row.dofs = trace.dofs();
    row.weights.resize(row.dofs.size());
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double weight = weights.at(points[k]);
    for (std::size_t i = 0; system.generalised && i < row.dofs.size(); ++i) {
      row.weights[i] += weight * trace.row(k)[i];
    }
    if (!system.generalised && trace.dof(k) >= 0) {
      row.dofs.push_back(trace.dof(k));
      row.weights.push_back(weight);
    }
    const std::span<const double> carried = trace.carried(k);
    row.carried.resize(carried.size());
    for (std::size_t c = 0; c < carried.size(); ++c) row.carried[c] += weight * carried[c];
  }
  return row;
}

/// Largest height of the waves of each pool, at a corner of its walls: the sum of those along x and
/// along y, of all its convective modes, at the samples of the probes.
class PoolWaves final : public Observer {
 public:
  explicit PoolWaves(const ObservedRun& run);

  std::int64_t next_due(std::int64_t step) const override { return run_.next_record_step(step); }
  StepNeeds begin(const CdLagrange& stepper) override;
  void finish(bool /*complete*/) override { look(); }
  void save(SavedState& saved) override {
    look();
    if (rank_of(run_.comm) == 0) saved.put("pool_waves", peaks_, 2);
  }
  void load(const SavedState& saved) override { saved.get("pool_waves", peaks_); }
  void report(RunStatistics& statistics) override;

 private:
  static constexpr std::size_t most_samples = 1000;

  /// Takes the samples that are kept into the peaks. Collective.
  void look();

  ObservedRun run_;
  std::vector<WaveRow> rows_;    ///< two per pool, along x and y
  std::vector<double> times_;    ///< of the samples since the last look
  std::vector<double> samples_;  ///< of these, part of this rank in each row [m]
  std::vector<double> peaks_;    ///< per pool: height [m], time [s]; alike on all ranks
};

PoolWaves::PoolWaves(const ObservedRun& run) : run_(run) {
  for (std::size_t s = 0; s < run.scene.structures.size(); ++s) {
    const Structure& structure = run.scene.structures[s];
    const auto first = std::ranges::find(structure.regions, true, &Region::of_water);
    auto region = static_cast<int>(first - structure.regions.begin());
    for (const Pool& pool : structure.pools) {
      std::array<std::map<TracePoint, double>, 2> weights;
      for (const WaterRegion& water : water_regions(pool)) {
        if (water.part == WaterPart::wave) {
          const auto mode = static_cast<std::size_t>(water.mode);
          add_wave(run.model.meshes[s], region, water.direction,
                   pool.water_along(water.direction).convective[mode].wave,
                   weights[water.direction]);
        }
        ++region;
      }
      for (const auto& along : weights) rows_.push_back(row_of(run.model, s, along));
    }
  }
  peaks_.resize(rows_.size());
}

StepNeeds PoolWaves::begin(const CdLagrange& stepper) {
  const State& state = stepper.state();
  for (const WaveRow& row : rows_) {
    const std::vector<double>& owned = state.structures[row.structure].displacement;
    double height = 0;
    for (std::size_t i = 0; i < row.dofs.size(); ++i) height += row.weights[i] * owned[row.dofs[i]];
    // One rank alone knows each point, and how far supports carry it.
    for (std::size_t c = 0; c < row.carried.size(); ++c) {
      height += row.carried[c] * state.supports.displacement[c];
    }
    samples_.push_back(height);
  }
  times_.push_back(stepper.time());
  if (times_.size() == most_samples) look();
  return {};
}

void PoolWaves::look() {
  MPI_Allreduce(MPI_IN_PLACE, samples_.data(), static_cast<int>(samples_.size()), MPI_DOUBLE,
                MPI_SUM, run_.comm);
  for (std::size_t t = 0; t < times_.size(); ++t) {
    const double* const heights = &samples_[t * rows_.size()];
    for (std::size_t p = 0; p < rows_.size(); p += 2) {
      const double corner = std::abs(heights[p]) + std::abs(heights[p + 1]);
      if (corner > peaks_[p]) std::ranges::copy(std::array{corner, times_[t]}, &peaks_[p]);
    }
  }
  times_.clear();
  samples_.clear();
}

void PoolWaves::report(RunStatistics& statistics) {
  std::size_t p = 0;
  for (const Structure& structure : run_.scene.structures) {
    for (const Pool& pool : structure.pools) {
      const double height = peaks_[2 * p];
      statistics.findings.add(
          "pools", pool.name,
          {{"wave_height", height},
           {"time", peaks_[2 * p + 1]},
           {"freeboard", pool.outline.freeboard}},
          "  {:-12s} waves up to {wave_height:.3g} m at {time:.4g} s, freeboard "
          "{freeboard:.3g} m\n",
          {pool.name});
      ++p;
    }
  }
}

}  // namespace

OutputKind pool_output() {
  return output<PoolWaves>({}, [](const ObservedRun& run) {
    return std::ranges::any_of(run.scene.structures,
                               [](const Structure& structure) { return !structure.pools.empty(); });
  });
}

}  // namespace pounding
