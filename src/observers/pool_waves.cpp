#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "common/parallel.h"
#include "common/saved_state.h"
#include "observers/base_motion.h"
#include "observers/observed_run.h"
#include "observers/run_statistics.h"
#include "scene/pool_reader.h"

namespace pounding {
namespace {

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

/// Height of the waves at the walls of a pool across a direction, by the weights of points.
DisplacementSum row_of(const Model& model, std::size_t structure,
                       const std::map<TracePoint, double>& of_points) {
  std::vector<TracePoint> points;
  std::vector<double> weights;
  for (const auto& [point, weight] : of_points) {
    points.push_back(point);
    weights.push_back(weight);
  }
  return {structure, points, weights, model.systems[structure], model.meshes[structure]};
}

/// Largest height of the waves of each pool, at a corner of its walls: the sum of those along x and
/// along y, of all its convective modes, at the samples of the probes.
class PoolWaves final : public Observer {
 public:
  explicit PoolWaves(const ObservedRun& run) : run_(run) {
    for (std::size_t s = 0; s < run.scene.structures.size(); ++s) {
      const Structure& structure = run.scene.structures[s];
      const auto first = std::ranges::find(structure.regions, true, &Region::of_water);
      auto region = static_cast<int>(first - structure.regions.begin());
      for (const Pool& pool : structure.pools) {
        if (!pool.is_tank()) continue;
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

  std::int64_t next_due(std::int64_t step) const override { return run_.next_record_step(step); }
  StepNeeds begin(const CdLagrange& stepper) override {
    for (const DisplacementSum& row : rows_) samples_.push_back(row.of(stepper));
    times_.push_back(stepper.time());
    if (times_.size() == most_samples) look();
    return {};
  }

  void finish(bool /*complete*/) override { look(); }
  void keep_state(const StateKeeper& state) override {
    look();
    state.table("pool_waves", peaks_, 2);
  }

  void report(RunStatistics& statistics) override {
    std::size_t p = 0;
    for (const Structure& structure : run_.scene.structures) {
      for (const Pool& pool : structure.pools) {
        if (!pool.is_tank()) continue;
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

 private:
  static constexpr std::size_t most_samples = 1000;

  /// Takes the samples that are kept into the peaks. Collective.
  void look() {
    reduce_over_ranks(run_.comm, MPI_SUM, samples_);
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

  ObservedRun run_;
  std::vector<DisplacementSum> rows_;  ///< two per pool, along x and y
  std::vector<double> times_;          ///< of the samples since the last look
  std::vector<double> samples_;        ///< of these, part of this rank in each row [m]
  std::vector<double> peaks_;          ///< per pool: height [m], time [s]; alike on all ranks
};

}  // namespace

OutputKind pool_output() {
  return output<PoolWaves>({}, [](const ObservedRun& run) {
    return std::ranges::any_of(run.scene.structures, [](const Structure& structure) {
      return std::ranges::any_of(structure.pools, &Pool::is_tank);
    });
  });
}

}  // namespace pounding
