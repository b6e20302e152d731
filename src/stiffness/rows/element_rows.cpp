#include "stiffness/rows/element_rows.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <tuple>

#include "common/lanes.h"

namespace pounding::stiffness {
namespace {

std::size_t index(LocalIndex i) {
  return static_cast<std::size_t>(i);
}

/// Axes of a shape with this many edges along each.
constexpr int dimensions(std::size_t lines) {
  return lines == 4 ? 3 : 2;
}

/// Corner bits of the edges along the run axis, near end; the far end has bit run_axis too.
template <std::size_t lines>
std::array<std::size_t, lines> near_corners(int run_axis) {
  std::array<std::size_t, lines> corners{};
  for (std::size_t l = 0; l < lines; ++l) {
    for (int other = 1; other < dimensions(lines); ++other) {
      if ((l >> (other - 1) & 1) != 0) {
        corners[l] |= std::size_t{1} << (run_axis + other) % dimensions(lines);
      }
    }
  }
  return corners;
}

/// Finds the chains, then the runs.
template <std::size_t lines>
class RowFinder {
 public:
  RowFinder(const std::vector<RowElement<lines>>& elements, LocalIndex node_count, int run_axis)
      : elements_(elements),
        near_(near_corners<lines>(run_axis)),
        far_(std::size_t{1} << run_axis),
        next_(index(node_count), -1),
        previous_(index(node_count), -1),
        chain_(index(node_count), -1),
        offset_(index(node_count), 0) {
    rows_.run_axis = run_axis;
  }

  ElementRows<lines> run() {
    for (const RowElement<lines>& element : elements_) link(element);
    for (LocalIndex node = 0; index(node) < next_.size(); ++node) {
      if (previous_[index(node)] < 0 && next_[index(node)] >= 0) follow(node);
    }
    number_chains();
    collect_runs();
    return std::move(rows_);
  }

 private:
  /// The first element decides where two disagree.
  void link(const RowElement<lines>& element) {
    for (const std::size_t corner : near_) {
      const LocalIndex near = element.nodes[corner];
      const LocalIndex far = element.nodes[corner | far_];
      if (next_[index(near)] < 0 && previous_[index(far)] < 0) {
        next_[index(near)] = far;
        previous_[index(far)] = near;
      }
    }
  }

  void follow(LocalIndex head) {
    std::vector<LocalIndex> nodes;
    for (LocalIndex node = head; node >= 0; node = next_[index(node)]) nodes.push_back(node);
    rows_.chains.push_back(std::move(nodes));
  }

  /// Orders chains as in memory, for which ends do not count: they may be numbered elsewhere.
  void number_chains() {
    std::sort(rows_.chains.begin(), rows_.chains.end(),
              [](const auto& a, const auto& b) { return a[a.size() / 2] < b[b.size() / 2]; });
    for (std::size_t c = 0; c < rows_.chains.size(); ++c) {
      for (std::size_t p = 0; p < rows_.chains[c].size(); ++p) {
        chain_[index(rows_.chains[c][p])] = static_cast<int>(c);
        offset_[index(rows_.chains[c][p])] = static_cast<int>(p);
      }
    }
  }

  bool in_chains(const RowElement<lines>& element) const {
    return std::all_of(near_.begin(), near_.end(), [&](std::size_t corner) {
      const LocalIndex near = element.nodes[corner];
      return chain_[index(near)] >= 0 && next_[index(near)] == element.nodes[corner | far_];
    });
  }

  void collect_runs() {
    std::vector<ElementRun<lines>> single;
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      if (!in_chains(elements_[e])) {
        rows_.left_over.push_back(e);
        continue;
      }
      ElementRun<lines> run{elements_[e].shape, {}, {}, 1};
      for (std::size_t l = 0; l < lines; ++l) {
        const LocalIndex node = elements_[e].nodes[near_[l]];
        run.chain[l] = chain_[index(node)];
        run.offset[l] = offset_[index(node)];
      }
      single.push_back(run);
    }
    std::sort(single.begin(), single.end(),
              [](const ElementRun<lines>& a, const ElementRun<lines>& b) {
                return std::tie(a.chain, a.offset, a.shape) < std::tie(b.chain, b.offset, b.shape);
              });
    for (const ElementRun<lines>& element : single) {
      if (rows_.runs.empty() || !continues(rows_.runs.back(), element)) {
        rows_.runs.push_back(element);
      } else {
        ++rows_.runs.back().count;
      }
    }
  }

  static bool continues(const ElementRun<lines>& run, const ElementRun<lines>& element) {
    if (run.shape != element.shape || run.chain != element.chain) return false;
    for (std::size_t l = 0; l < lines; ++l) {
      if (element.offset[l] != run.offset[l] + run.count) return false;
    }
    return true;
  }

  const std::vector<RowElement<lines>>& elements_;
  std::array<std::size_t, lines> near_;
  std::size_t far_;
  std::vector<LocalIndex> next_;
  std::vector<LocalIndex> previous_;
  std::vector<int> chain_;
  std::vector<int> offset_;
  ElementRows<lines> rows_;
};

/// Expected time of a product, in cycles of a processor with vectors of lane_count doubles.
template <std::size_t lines>
double expected_cycles(const ElementRows<lines>& rows) {
  constexpr double per_batch = 50;
  constexpr double per_run = 200;
  constexpr double components = lines == 4 ? 3 : 6;
  constexpr double per_near_value = 5.0 / 3;
  constexpr double per_far_value = 4;
  constexpr LocalIndex near_step = 8;  // nodes; beyond, each node opens cache lines of its own
  double cycles = 400.0 * static_cast<double>(rows.left_over.size());
  for (const ElementRun<lines>& run : rows.runs) {
    const LocalIndex batches = (run.count + lane_count - 1) / lane_count;
    cycles += per_run + per_batch * batches;
  }
  for (const auto& chain : rows.chains) {
    const std::size_t middle = chain.size() / 2;
    const bool near = std::abs(chain[middle] - chain[middle - 1]) <= near_step;
    cycles +=
        components * (near ? per_near_value : per_far_value) * static_cast<double>(chain.size());
  }
  return cycles;
}

}  // namespace

template <std::size_t lines>
ElementRows<lines> find_rows(const std::vector<RowElement<lines>>& elements, LocalIndex node_count,
                             int run_axis) {
  return RowFinder<lines>(elements, node_count, run_axis).run();
}

template <std::size_t lines>
ElementRows<lines> best_rows(const std::vector<RowElement<lines>>& elements,
                             LocalIndex node_count) {
  ElementRows<lines> best = find_rows(elements, node_count, 0);
  double least = expected_cycles(best);
  for (int axis = 1; axis < dimensions(lines); ++axis) {
    ElementRows<lines> rows = find_rows(elements, node_count, axis);
    const double cycles = expected_cycles(rows);
    if (cycles < least) {
      least = cycles;
      best = std::move(rows);
    }
  }
  return best;
}

template ElementRows<2> find_rows(const std::vector<RowElement<2>>&, LocalIndex, int);
template ElementRows<4> find_rows(const std::vector<RowElement<4>>&, LocalIndex, int);
template ElementRows<2> best_rows(const std::vector<RowElement<2>>&, LocalIndex);
template ElementRows<4> best_rows(const std::vector<RowElement<4>>&, LocalIndex);

}  // namespace pounding::stiffness
