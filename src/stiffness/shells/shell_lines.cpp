#include "stiffness/shells/shell_lines.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include "common/memory.h"
#include "common/wide_lanes.h"
#include "stiffness/rows/chain_line.h"
#include "stiffness/shells/shell_kernel.h"

namespace pounding::stiffness {
namespace {

constexpr int components = 6;
constexpr int arrays_per_line = 2 * components;

/// Room for `length` values and those that the kernel writes beyond them.
int padded(int length) {
  return (length + 2 * most_lanes) / most_lanes * most_lanes;
}

/// The product of the rectangular shells that lie in the planes across one axis of a frame. The
/// buffer holds the chains of nodes that are in use, a line of twelve arrays each, along and about
/// the run, across it, and the normal:
///
///     w -> [load chain] -> u0[] .. u5[] -> [runs] -> f0[] .. f5[] -> [store chain] -> q
class ShellLines final : public ElementLines {
 public:
  ShellLines(const DofSlots& slots, const Matrix3& axes, int normal,
             const std::vector<RectangleShape>& shapes, const RectangleRows& rows)
      : owned_dofs_(slots.owned_dofs) {
    const int run = rows.run_axis;
    axes_ = LineAxes(axes, {(normal + 1 + run) % 3, (normal + 2 - run) % 3, normal});
    for (const RectangleShape& shape : shapes) {
      const auto split = split_rectangle(shape.properties, shape.lengths, run);
      if (!split) throw std::logic_error("ShellLines: a shape that does not split");
      splits_.push_back(*split);
    }
    for (const auto& nodes : rows.chains) add_chain(slots, nodes);
    schedule(rows);
  }

  std::size_t chain_count() const override { return stores_.size(); }
  std::vector<LocalIndex> chain_dofs(std::size_t number) const override {
    const Chain& chain = chain_of(stores_[number].chain);
    std::vector<LocalIndex> dofs;
    for (int p = 0; p < chain.length; ++p) {
      for (int c = 0; c < components; ++c) {
        const LocalIndex dof = slot(chain, p, c);
        if (dof >= 0 && dof < owned_dofs_) dofs.push_back(dof);
      }
    }
    return dofs;
  }
  DofRange chain_range(std::size_t number) const override {
    return chain_of(stores_[number].chain).range;
  }
  void set_handed_over(const std::vector<char>& handed_over) override {
    for (std::size_t s = 0; s < stores_.size(); ++s) {
      stores_[s].handed_over = handed_over[s] != 0;
      const DofRange range = chain_of(stores_[s].chain).range;
      const std::size_t size = range.end - range.begin;
      if (range_.size() < size) range_.resize(size);
    }
  }
  void apply(const StiffnessArgument& w, const double* ghosts, double* q,
             ForceReceiver& receiver) const override {
    std::size_t loaded = 0;
    std::size_t stored = 0;
    for (const Run& run : runs_) {
      while (loaded < run.loads_end) load_chain(loads_[loaded++], w, ghosts);
      std::array<ShellLine, 2> lines;
      for (std::size_t l = 0; l < 2; ++l) {
        double* const start = buffer_.data() + run.start[l];
        lines[l] = {start, start + components * line_stride_};
      }
      add_shell_run(splits_[run.shape], lines, line_stride_, run.count);
      while (stored < run.stores_end) store_chain(stores_[stored++], q, receiver);
    }
  }

 private:
  struct Chain {
    int begin = 0;  ///< into slots_: one per node if plain, else six
    int length = 0;
    bool plain = false;  ///< every node owns six dofs in a row
    DofRange range;      ///< as in chain_range
  };
  struct Transfer {
    int chain = 0;
    int start = 0;  ///< of the chain's line, into buffer_
    bool handed_over = false;
  };
  /// The entries of loads_ and stores_ up to the given ends come before it, after it.
  struct Run {
    int shape = 0;
    int count = 0;
    std::array<int, 2> start{};  ///< of the first nodes, into buffer_
    std::size_t loads_end = 0;
    std::size_t stores_end = 0;
  };

  void add_chain(const DofSlots& slots, const std::vector<LocalIndex>& nodes) {
    Chain chain{static_cast<int>(slots_.size()), static_cast<int>(nodes.size()), true, {}};
    bool contiguous = true;
    for (const LocalIndex node : nodes) {
      const auto& slot = slots.of_node[node];
      const LocalIndex first = slot[0];
      for (int c = 0; c < components; ++c) {
        chain.plain = chain.plain && first >= 0 && slot[c] == first + c;
      }
      chain.plain = chain.plain && first + components <= owned_dofs_;
      contiguous = contiguous && chain.plain && (node == nodes[0] || first == chain.range.end);
      if (node == nodes[0]) chain.range.begin = first;
      chain.range.end = first + components;
    }
    if (!contiguous) chain.range = {};
    for (const LocalIndex node : nodes) {
      const auto& slot = slots.of_node[node];
      slots_.insert(slots_.end(), slot.begin(), slot.begin() + (chain.plain ? 1 : components));
    }
    line_stride_ = std::max(line_stride_, padded(chain.length));
    chains_.push_back(chain);
  }
  /// Gives each chain a line of the buffer from its first run to its last one.
  void schedule(const RectangleRows& rows) {
    const int line_size = arrays_per_line * line_stride_;
    std::vector<int> uses(rows.chains.size(), 0);
    for (const RectangleRun& run : rows.runs) {
      for (const int chain : run.chain) ++uses[chain];
    }
    std::vector<int> start(rows.chains.size(), -1);
    std::vector<int> free_lines;
    int line_count = 0;
    for (const RectangleRun& row : rows.runs) {
      Run run{row.shape, row.count, {}, 0, 0};
      for (std::size_t l = 0; l < 2; ++l) {
        int& line = start[row.chain[l]];
        if (line < 0) {
          if (free_lines.empty()) free_lines.push_back(line_count++ * line_size);
          line = free_lines.back();
          free_lines.pop_back();
          loads_.push_back({row.chain[l], line});
        }
        run.start[l] = line + row.offset[l];
      }
      for (const int chain : row.chain) {
        if (--uses[chain] > 0) continue;
        stores_.push_back({chain, start[chain]});
        free_lines.push_back(stores_.back().start);
      }
      run.loads_end = loads_.size();
      run.stores_end = stores_.size();
      runs_.push_back(run);
    }
    buffer_.assign(line_count * line_size + most_lanes, 0.0);
  }
  void load_chain(const Transfer& transfer, const StiffnessArgument& w,
                  const double* ghosts) const {
    const Chain& chain = chain_of(transfer.chain);
    double* const line = buffer_.data() + transfer.start;
    const SixArrays to = arrays(line);
    if (chain.plain) {
      load_shell_nodes(w, slots_.data() + chain.begin, chain.length, to);
    } else {
      for (int p = 0; p < chain.length; ++p) {
        for (int c = 0; c < components; ++c) {
          to[c][p] = value_at(slot(chain, p, c), owned_dofs_, w, ghosts);
        }
      }
    }
    rotate(false, chain.length, line);
    for (int c = components; c < arrays_per_line; ++c) {
      double* const force = line + c * line_stride_;
      for (int p = 0; p < chain.length; p += wide_lane_count) store(force + p, WideLanes{});
    }
  }
  void store_chain(const Transfer& transfer, double* q, ForceReceiver& receiver) const {
    const Chain& chain = chain_of(transfer.chain);
    double* const line = buffer_.data() + transfer.start + components * line_stride_;
    rotate(true, chain.length, line);
    const SixArrays from = arrays(line);
    if (!transfer.handed_over) {
      for (int p = 0; p < chain.length; ++p) {
        for (int c = 0; c < components; ++c) {
          const LocalIndex dof = slot(chain, p, c);
          if (dof >= 0 && dof < owned_dofs_) q[dof] += from[c][p];
        }
      }
      return;
    }
    const auto [begin, end] = chain.range;
    store_shell_nodes(from, slots_.data() + chain.begin, chain.length, begin, range_.data());
    receiver.receive(begin, end, range_.data());
  }
  /// Turns displacements and rotations, or forces and moments, from global axes or back.
  void rotate(bool back, int length, double* values) const {
    axes_.turn(back, length, line_stride_, values);
    axes_.turn(back, length, line_stride_, values + 3 * line_stride_);
  }
  /// The arrays of x, y, z and of the rotations about them, of a line's displacements or forces.
  SixArrays arrays(double* values) const {
    SixArrays result{};
    for (std::size_t c = 0; c < result.size(); ++c) {
      result[c] = values + (axes_.component[c % 3] + (c < 3 ? 0 : 3)) * line_stride_;
    }
    return result;
  }
  LocalIndex slot(const Chain& chain, int node, int component) const {
    const LocalIndex* const slots = slots_.data() + chain.begin;
    return chain.plain ? slots[node] + component : slots[components * node + component];
  }
  const Chain& chain_of(int number) const { return chains_[number]; }

  LocalIndex owned_dofs_ = 0;
  LineAxes axes_;                   ///< along the run, across it, normal
  std::vector<ShellSplit> splits_;  ///< per shape
  std::vector<Chain> chains_;
  std::vector<LocalIndex> slots_;
  std::vector<Run> runs_;
  std::vector<Transfer> loads_;
  std::vector<Transfer> stores_;
  int line_stride_ = 0;
  /// Lines of shape (12, line_stride): displacement, force. Work space of `apply`.
  mutable LaneArray buffer_;
  mutable LaneArray range_;  ///< forces of the range that is being handed over
};

}  // namespace

std::unique_ptr<ElementLines> shell_lines(const DofSlots& slots, const Matrix3& axes, int normal,
                                          const std::vector<RectangleShape>& shapes,
                                          const RectangleRows& rows) {
  return std::make_unique<ShellLines>(slots, axes, normal, shapes, rows);
}

}  // namespace pounding::stiffness
