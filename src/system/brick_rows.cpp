#include "system/brick_rows.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <tuple>

#include "system/lanes.h"

namespace pounding {
namespace {

std::size_t index(LocalIndex i) {
  return static_cast<std::size_t>(i);
}

/// Corner bits of the four edges along the run axis, near end; the far end has bit run_axis too.
std::array<std::size_t, 4> near_corners(int run_axis) {
  const std::size_t first = std::size_t{1} << (run_axis + 1) % 3;
  const std::size_t second = std::size_t{1} << (run_axis + 2) % 3;
  return {0, first, second, first | second};
}

/// Finds the chains, then the runs.
class RowFinder {
 public:
  RowFinder(const std::vector<BrickElement>& bricks, LocalIndex node_count, int run_axis)
      : bricks_(bricks),
        near_(near_corners(run_axis)),
        far_(std::size_t{1} << run_axis),
        next_(index(node_count), -1),
        previous_(index(node_count), -1),
        chain_(index(node_count), -1),
        offset_(index(node_count), 0) {
    rows_.run_axis = run_axis;
  }

  BrickRows run() {
    for (const BrickElement& brick : bricks_) link(brick);
    for (LocalIndex node = 0; index(node) < next_.size(); ++node) {
      if (previous_[index(node)] < 0 && next_[index(node)] >= 0) follow(node);
    }
    collect_runs();
    return std::move(rows_);
  }

 private:
  /// The first brick decides where two disagree.
  void link(const BrickElement& brick) {
    for (const std::size_t corner : near_) {
      const LocalIndex near = brick.nodes[corner];
      const LocalIndex far = brick.nodes[corner | far_];
      if (next_[index(near)] < 0 && previous_[index(far)] < 0) {
        next_[index(near)] = far;
        previous_[index(far)] = near;
      }
    }
  }

  void follow(LocalIndex head) {
    std::vector<LocalIndex> nodes;
    for (LocalIndex node = head; node >= 0; node = next_[index(node)]) {
      chain_[index(node)] = static_cast<int>(rows_.chains.size());
      offset_[index(node)] = static_cast<int>(nodes.size());
      nodes.push_back(node);
    }
    rows_.chains.push_back(std::move(nodes));
  }

  bool in_chains(const BrickElement& brick) const {
    return std::all_of(near_.begin(), near_.end(), [&](std::size_t corner) {
      const LocalIndex near = brick.nodes[corner];
      return chain_[index(near)] >= 0 && next_[index(near)] == brick.nodes[corner | far_];
    });
  }

  void collect_runs() {
    std::vector<BrickRun> single;
    for (std::size_t e = 0; e < bricks_.size(); ++e) {
      if (!in_chains(bricks_[e])) {
        rows_.left_over.push_back(e);
        continue;
      }
      BrickRun run{bricks_[e].shape, {}, {}, 1};
      for (std::size_t l = 0; l < 4; ++l) {
        const LocalIndex node = bricks_[e].nodes[near_[l]];
        run.chain[l] = chain_[index(node)];
        run.offset[l] = offset_[index(node)];
      }
      single.push_back(run);
    }
    std::sort(single.begin(), single.end(), [](const BrickRun& a, const BrickRun& b) {
      return std::tie(a.chain, a.offset, a.shape) < std::tie(b.chain, b.offset, b.shape);
    });
    for (const BrickRun& brick : single) {
      if (rows_.runs.empty() || !continues(rows_.runs.back(), brick)) {
        rows_.runs.push_back(brick);
      } else {
        ++rows_.runs.back().count;
      }
    }
  }

  static bool continues(const BrickRun& run, const BrickRun& brick) {
    if (run.shape != brick.shape || run.chain != brick.chain) return false;
    for (std::size_t l = 0; l < 4; ++l) {
      if (brick.offset[l] != run.offset[l] + run.count) return false;
    }
    return true;
  }

  const std::vector<BrickElement>& bricks_;
  std::array<std::size_t, 4> near_;
  std::size_t far_;
  std::vector<LocalIndex> next_;
  std::vector<LocalIndex> previous_;
  std::vector<int> chain_;
  std::vector<int> offset_;
  BrickRows rows_;
};

/// Expected time of a product, in cycles of a processor with vectors of lane_count doubles.
double expected_cycles(const BrickRows& rows) {
  constexpr double per_batch = 50;
  constexpr double per_run = 200;
  constexpr double per_near_node = 5;
  constexpr double per_far_node = 12;
  constexpr LocalIndex near_step = 8;  // nodes; beyond, each node opens cache lines of its own
  double cycles = 400.0 * static_cast<double>(rows.left_over.size());
  for (const BrickRun& run : rows.runs) {
    cycles += per_run + per_batch * ((run.count + lane_count - 1) / lane_count);
  }
  for (const auto& chain : rows.chains) {
    const bool near = std::abs(chain[1] - chain[0]) <= near_step;
    cycles += (near ? per_near_node : per_far_node) * static_cast<double>(chain.size());
  }
  return cycles;
}

}  // namespace

BrickRows find_brick_rows(const std::vector<BrickElement>& bricks, LocalIndex node_count,
                          int run_axis) {
  return RowFinder(bricks, node_count, run_axis).run();
}

BrickRows best_brick_rows(const std::vector<BrickElement>& bricks, LocalIndex node_count) {
  BrickRows best = find_brick_rows(bricks, node_count, 0);
  double least = expected_cycles(best);
  for (int axis = 1; axis < 3; ++axis) {
    BrickRows rows = find_brick_rows(bricks, node_count, axis);
    const double cycles = expected_cycles(rows);
    if (cycles < least) {
      least = cycles;
      best = std::move(rows);
    }
  }
  return best;
}

}  // namespace pounding
