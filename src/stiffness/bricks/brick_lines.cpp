#include "stiffness/bricks/brick_lines.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>

#include "common/memory.h"
#include "common/wide_lanes.h"
#include "stiffness/bricks/brick_chains.h"
#include "stiffness/bricks/brick_stencil.h"
#include "stiffness/bricks/line_schedule.h"
#include "stiffness/rows/chain_line.h"

namespace pounding::stiffness {
namespace {

ComponentArrays shifted(const ComponentArrays& arrays, int nodes) {
  return {arrays.x + nodes, arrays.y + nodes, arrays.z + nodes};
}

int round_up(int count) {
  return (count + most_lanes - 1) / most_lanes * most_lanes;
}

/// The product of the bricks of one frame. The buffer holds the chains of nodes, and the pairs of
/// chains, that are in use:
///
///     w -> [load chain] -> x[] y[] z[] -> [split pair] -> sums, differences -> [steps]
///       -> forces of sums, differences -> [join pair] -> fx[] fy[] fz[] -> [store chain] -> q
///
/// What the steps work on stays in the nearest cache. The chains of a layer one brick thick hold
/// the sums and differences of their pair themselves. Ranges finished one after the other that lie
/// side by side are handed over as one, as long as they stay small.
class BrickLines final : public ElementLines {
 public:
  BrickLines(const DofSlots& slots, const Matrix3& axes, const std::vector<BrickShape>& shapes,
             const BrickRows& rows)
      : owned_dofs_(slots.owned_dofs) {
    const BrickPairs pairs = pair_chains(rows);
    axes_ = LineAxes(axes, pairs.axes);
    for (const BrickShape& shape : shapes) {
      Vector3 lengths{};
      for (std::size_t d = 0; d < 3; ++d) lengths[d] = shape.lengths[pairs.axes[d]];
      const auto split = split_brick(shape.type, shape.properties, lengths);
      if (!split) throw std::logic_error("BrickLines: a shape that does not split");
      stencils_.push_back(brick_stencil(*split));
    }
    std::vector<ChainForm> chain_forms;
    for (const auto& nodes : rows.chains) {
      const BrickChain& chain = chains_.add(slots, nodes);
      chain_forms.push_back({chain.length, chain.row});
      line_stride_ = std::max(line_stride_, round_up(chain.length + most_lanes));
    }
    schedule_ = schedule_lines(pairs, chain_forms, line_stride_);
    for (const PairSplit& split : schedule_.splits) {
      pair_loads_.push_back(split.load ? plan_load(split.slot) : PairLoad{});
    }
    buffer_.assign(schedule_.buffer_size, 0.0);
  }

  std::size_t chain_count() const override { return schedule_.stores.size(); }
  std::vector<LocalIndex> chain_dofs(std::size_t number) const override {
    const BrickChain& chain = chains_.at(schedule_.stores[number].chain);
    std::vector<LocalIndex> dofs;
    for (int p = 0; p < chain.length; ++p) {
      for (int c = 0; c < 3; ++c) {
        const LocalIndex dof = chains_.slot(chain, p, c);
        if (dof >= 0 && dof < owned_dofs_) dofs.push_back(dof);
      }
    }
    return dofs;
  }
  DofRange chain_range(std::size_t number) const override {
    return chains_.at(schedule_.stores[number].chain).range;
  }
  void set_handed_over(const std::vector<char>& handed_over) override {
    std::vector<ChainStore>& stores = schedule_.stores;
    for (std::size_t s = 0; s < stores.size(); ++s) stores[s].handed_over = handed_over[s] != 0;
    std::size_t begin = 0;
    for (const LineStep& step : schedule_.steps) {
      sort_stores(begin, step.stores_end);
      begin = step.stores_end;
    }
    make_room();
  }
  void apply(const StiffnessArgument& w, const double* ghosts, double* q,
             ForceReceiver& receiver) const override {
    std::size_t loaded = 0;
    std::size_t split = 0;
    std::size_t joined = 0;
    std::size_t stored = 0;
    for (const LineStep& step : schedule_.steps) {
      while (loaded < step.loads_end) load_chain(schedule_.loads[loaded++], w, ghosts);
      while (split < step.splits_end) split_chains(split++, w, ghosts);
      apply_step(step);
      while (joined < step.joins_end) join_chains(schedule_.joins[joined++]);
      while (stored < step.stores_end) store_chain(schedule_.stores[stored++], q, receiver);
    }
  }

 private:
  struct PairEnd {
    int node = 0;
    std::array<LocalIndex, 3> near{};  ///< slots of x, y, z, as in ChainEnd
    std::array<LocalIndex, 3> far{};
  };
  /// How a pair of rows is loaded: a stretch of both in vectors, other nodes one by one.
  struct PairLoad {
    int begin = 0;
    int count = 0;
    std::array<LocalIndex, 2> first{};  ///< dofs of the first node
    std::vector<PairEnd> ends;
  };

  /// Sorts the stores of one step in the order of their dofs.
  void sort_stores(std::size_t begin, std::size_t end) {
    const auto first_of = [this](const ChainStore& store) {
      return chains_.at(store.chain).range.begin;
    };
    std::stable_sort(
        schedule_.stores.begin() + static_cast<std::ptrdiff_t>(begin),
        schedule_.stores.begin() + static_cast<std::ptrdiff_t>(end),
        [&](const ChainStore& a, const ChainStore& b) { return first_of(a) < first_of(b); });
  }
  /// Room for the forces of the longest core.
  void make_room() {
    LocalIndex added = 0;
    LocalIndex handed_over = 0;
    for (const ChainStore& store : schedule_.stores) {
      const DofRange range = chains_.at(store.chain).range;
      LocalIndex& longest = store.handed_over ? handed_over : added;
      longest = std::max(longest, range.end - range.begin);
    }
    if (added_.size() < static_cast<std::size_t>(added)) added_.resize(added, 0.0);
    range_.assign(static_cast<std::size_t>(round_up(handed_over + most_lanes)), 0.0);
  }
  void load_chain(const ChainLoad& load, const StiffnessArgument& w, const double* ghosts) const {
    const BrickChain& chain = chains_.at(load.chain);
    const ComponentArrays to = displacements(load.start);
    const ComponentArrays core = shifted(to, chain.first);
    if (chain.row) {
      load_row(w, chain.range.begin, chain.core, core);
    } else {
      load_nodes(w, chains_.slots(chain), chain.core, core);
    }
    for (const ChainEnd& end : chains_.ends(chain)) {
      const Vector3 x = value(end.slot, w, ghosts);
      to.x[end.node] = x[0];
      to.y[end.node] = x[1];
      to.z[end.node] = x[2];
    }
    for (int p = chain.length; p < round_up(chain.length); ++p) to.x[p] = to.y[p] = to.z[p] = 0;
    axes_.turn(false, chain.length, line_stride_, buffer_.data() + load.start);
    if (load.clear) clear_forces(load.start, chain.length);
  }
  /// w of a node, less its origin.
  Vector3 value(const std::array<LocalIndex, 3>& slot, const StiffnessArgument& w,
                const double* ghosts) const {
    return {value_at(slot[0], owned_dofs_, w, ghosts) - w.origin[0],
            value_at(slot[1], owned_dofs_, w, ghosts) - w.origin[1],
            value_at(slot[2], owned_dofs_, w, ghosts) - w.origin[2]};
  }
  /// Common part of the two cores of a pair of rows, and the nodes beside that.
  PairLoad plan_load(const PairSlot& slot) const {
    const BrickChain& near = chains_.at(slot.chain[0]);
    const BrickChain& far = chains_.at(slot.chain[1]);
    PairLoad load;
    load.begin = std::max(near.first, far.first);
    load.count = std::max(0, std::min(near.first + near.core, far.first + far.core) - load.begin);
    load.first = {near.range.begin + 3 * (load.begin - near.first),
                  far.range.begin + 3 * (load.begin - far.first)};
    for (int p = 0; p < slot.length; ++p) {
      if (load.begin <= p && p < load.begin + load.count) continue;
      PairEnd& end = load.ends.emplace_back();
      end.node = p;
      for (int c = 0; c < 3; ++c) {
        end.near[c] = chains_.slot(near, p, c);
        end.far[c] = chains_.slot(far, p, c);
      }
    }
    return load;
  }
  /// Sums and differences of two chains that have not been loaded.
  void load_pair(const PairSlot& slot, const PairLoad& load, const StiffnessArgument& w,
                 const double* ghosts) const {
    const ComponentArrays sum = displacements(slot.line[0]);
    const ComponentArrays difference = displacements(slot.line[1]);
    load_row_pair(w, load.first, load.count, shifted(sum, load.begin),
                  shifted(difference, load.begin));
    for (const PairEnd& end : load.ends) {
      const Vector3 near = value(end.near, w, ghosts);
      const Vector3 far = value(end.far, w, ghosts);
      sum.x[end.node] = near[0] + far[0];
      sum.y[end.node] = near[1] + far[1];
      sum.z[end.node] = near[2] + far[2];
      difference.x[end.node] = far[0] - near[0];
      difference.y[end.node] = far[1] - near[1];
      difference.z[end.node] = far[2] - near[2];
    }
  }
  void split_chains(std::size_t number, const StiffnessArgument& w, const double* ghosts) const {
    const PairSplit& split = schedule_.splits[number];
    const PairSlot& slot = split.slot;
    double* const buffer = buffer_.data();
    if (split.load) {
      load_pair(slot, pair_loads_[number], w, ghosts);
      for (const int line : slot.line) axes_.turn(false, slot.length, line_stride_, buffer + line);
    } else {
      split_pair(buffer + slot.node[0], buffer + slot.node[1], slot.length, line_stride_,
                 {buffer + slot.line[0], buffer + slot.line[1]});
    }
    if (split.clear) {
      clear_forces(slot.line[0], slot.length);
      clear_forces(slot.line[1], slot.length);
    }
  }
  void apply_step(const LineStep& step) const {
    std::array<PairLine, 3> lines;
    for (std::size_t i = 0; i < 3; ++i) {
      lines[i] = {buffer_.data() + step.start[i][0], buffer_.data() + step.start[i][1]};
    }
    add_line_forces(stencils_[step.shape], step.sides, step.first_behind, lines[0], lines[1],
                    lines[2], line_stride_, step.count);
  }
  void join_chains(const PairJoin& join) const {
    const auto& [slot, first] = join;
    double* const buffer = buffer_.data();
    join_pair({buffer + slot.line[0], buffer + slot.line[1]}, slot.length, line_stride_, first,
              buffer + slot.node[0], buffer + slot.node[1]);
  }
  void store_chain(const ChainStore& store, double* q, ForceReceiver& receiver) const {
    const BrickChain& chain = chains_.at(store.chain);
    axes_.turn(true, chain.length, line_stride_, buffer_.data() + store.start + 3 * line_stride_);
    add_ends(store, q);
    if (!store.handed_over) {
      add_core(store, q);
      return;
    }
    collect_forces(store, range_.data());
    receiver.receive(chain.range.begin, chain.range.end, range_.data());
  }
  /// Adds the forces of a chain to q.
  void add_core(const ChainStore& store, double* q) const {
    const BrickChain& chain = chains_.at(store.chain);
    if (chain.range.empty()) return;
    const LocalIndex size = chain.range.end - chain.range.begin;
    if (!chain.row) std::fill(added_.begin(), added_.begin() + size, 0.0);
    collect_forces(store, added_.data());
    for (LocalIndex i = 0; i < size; ++i) q[chain.range.begin + i] += added_[i];
  }
  /// Adds the forces of the nodes outside the core to q.
  void add_ends(const ChainStore& store, double* q) const {
    const BrickChain& chain = chains_.at(store.chain);
    const ComponentArrays force = forces(store.start);
    const auto add = [&](LocalIndex dof, double value) {
      if (dof >= 0 && dof < owned_dofs_) q[dof] += value;
    };
    for (const ChainEnd& end : chains_.ends(chain)) {
      add(end.slot[0], force.x[end.node]);
      add(end.slot[1], force.y[end.node]);
      add(end.slot[2], force.z[end.node]);
    }
  }
  /// Forces of a core with a range, that of its first dof to range[0].
  void collect_forces(const ChainStore& store, double* range) const {
    const BrickChain& chain = chains_.at(store.chain);
    const ComponentArrays core = shifted(forces(store.start), chain.first);
    if (chain.row) {
      store_row(core, chain.core, range);
    } else {
      store_nodes(core, chains_.slots(chain), chain.core, chain.range.begin, range);
    }
  }
  ComponentArrays displacements(int start) const {
    double* const line = buffer_.data() + start;
    return {line + axes_.component[0] * line_stride_, line + axes_.component[1] * line_stride_,
            line + axes_.component[2] * line_stride_};
  }
  ComponentArrays forces(int start) const { return displacements(start + 3 * line_stride_); }
  void clear_forces(int start, int length) const {
    for (int c = 3; c < 6; ++c) {
      double* const force = buffer_.data() + start + c * line_stride_;
      for (int p = 0; p < length; p += wide_lane_count) store(force + p, WideLanes{});
    }
  }

  LocalIndex owned_dofs_ = 0;
  LineAxes axes_;                       ///< those of the pairs
  std::vector<BrickStencil> stencils_;  ///< per shape
  BrickChains chains_;
  LineSchedule schedule_;
  std::vector<PairLoad> pair_loads_;  ///< per split
  int line_stride_ = 0;
  /// Lines of shape (6, line_stride): displacement, force. Work space of `apply`.
  mutable LaneArray buffer_;
  mutable LaneArray range_;  ///< forces of a core until they are handed over
  mutable LaneArray added_;  ///< of a chain that is added to q
};

}  // namespace

std::unique_ptr<ElementLines> brick_lines(const DofSlots& slots, const Matrix3& axes,
                                          const std::vector<BrickShape>& shapes,
                                          const BrickRows& rows) {
  return std::make_unique<BrickLines>(slots, axes, shapes, rows);
}

}  // namespace pounding::stiffness
