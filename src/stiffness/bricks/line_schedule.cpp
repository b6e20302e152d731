#include "stiffness/bricks/line_schedule.h"

#include <cstddef>

namespace pounding::stiffness {
namespace {

constexpr int arrays_per_line = 6;

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

/// Lines of the buffer that are in use.
class LinePool {
 public:
  explicit LinePool(int line_size) : line_size_(line_size) {}

  int take() {
    if (free_.empty()) free_.push_back(lines_++ * line_size_);
    const int line = free_.back();
    free_.pop_back();
    return line;
  }
  void give_back(int line) { free_.push_back(line); }
  int size() const { return lines_ * line_size_; }

 private:
  int line_size_;
  int lines_ = 0;
  std::vector<int> free_;
};

class Scheduler {
 public:
  Scheduler(const BrickPairs& pairs, const std::vector<ChainForm>& chains, int stride)
      : pairs_(pairs),
        chains_(chains),
        pool_(arrays_per_line * stride),
        chain_states_(chains.size()),
        pair_states_(pairs.pairs.size()) {
    for (const PairStep& step : pairs.steps) {
      for (const int pair : step.pair) {
        if (pair >= 0) ++pair_states_[index(pair)].uses;
      }
    }
    for (const ChainPair& pair : pairs.pairs) {
      ++chain_states_[index(pair.near)].uses;
      ++chain_states_[index(pair.far)].uses;
    }
  }

  LineSchedule run() {
    for (const PairStep& step : pairs_.steps) add_step(step);
    result_.buffer_size = pool_.size();
    return std::move(result_);
  }

 private:
  struct ChainState {
    int uses = 0;   ///< pairs to come
    int line = -1;  ///< in the buffer, if it is there
    int load = -1;  ///< number of its load, if it has one
    int joins = 0;  ///< so far
  };
  struct PairState {
    int uses = 0;  ///< steps to come
    bool open = false;
    PairSlot slot;
  };

  void add_step(const PairStep& pair_step) {
    LineStep step;
    step.shape = pair_step.shape;
    step.sides = pair_step.sides;
    step.count = pair_step.count;
    for (const std::size_t i : {0, 1, 2}) {
      if (pair_step.pair[i] < 0) continue;
      PairState& pair = pair_states_[index(pair_step.pair[i])];
      if (!pair.open) {
        const bool covered = i == 2 && pair_step.offset[i] == 0 &&
                             pair_step.count + 1 == pairs_.pairs[index(pair_step.pair[i])].length;
        open(pair_step.pair[i], !covered);
        step.first_behind = covered;
      }
      step.start[i] = {pair.slot.line[0] + pair_step.offset[i],
                       pair.slot.line[1] + pair_step.offset[i]};
    }
    for (const int p : pair_step.pair) {
      if (p >= 0 && --pair_states_[index(p)].uses == 0) close(p);
    }
    step.loads_end = result_.loads.size();
    step.splits_end = result_.splits.size();
    step.joins_end = result_.joins.size();
    step.stores_end = result_.stores.size();
    result_.steps.push_back(step);
  }

  void open(int number, bool clear) {
    const ChainPair& pair = pairs_.pairs[index(number)];
    const bool load = pair.alone && chains_[index(pair.near)].row && chains_[index(pair.far)].row;
    PairState& state = pair_states_[index(number)];
    state.open = true;
    state.slot = {{pair.near, pair.far},
                  {start_chain(pair.near, !load) + pair.near_begin,
                   start_chain(pair.far, !load) + pair.far_begin},
                  {},
                  pair.length};
    if (pair.alone) {
      state.slot.line = state.slot.node;
    } else {
      state.slot.line = {pool_.take(), pool_.take()};
    }
    result_.splits.push_back({state.slot, clear, load});
  }

  /// A chain's line in the buffer; `load`: its nodes' values, if they are not there.
  int start_chain(int number, bool load) {
    ChainState& chain = chain_states_[index(number)];
    if (chain.line < 0) {
      chain.line = pool_.take();
      if (load) {
        chain.load = static_cast<int>(result_.loads.size());
        result_.loads.push_back({number, chain.line, false});
      }
    }
    return chain.line;
  }

  void close(int number) {
    const ChainPair& pair = pairs_.pairs[index(number)];
    const PairSlot& slot = pair_states_[index(number)].slot;
    const std::array<bool, 2> first{join_chain(pair.near, pair), join_chain(pair.far, pair)};
    result_.joins.push_back({slot, first});
    if (!pair.alone) {
      pool_.give_back(slot.line[0]);
      pool_.give_back(slot.line[1]);
    }
    for (const int number_of_chain : slot.chain) {
      ChainState& chain = chain_states_[index(number_of_chain)];
      if (--chain.uses > 0) continue;
      result_.stores.push_back({number_of_chain, chain.line});
      pool_.give_back(chain.line);
    }
  }

  /// Whether a pair can set the forces of its chain; if it is the first but does not reach all of
  /// the chain's nodes, they must have been cleared.
  bool join_chain(int number, const ChainPair& pair) {
    ChainState& chain = chain_states_[index(number)];
    if (chain.joins++ > 0) return false;
    if (pair.length == chains_[index(number)].length) return true;
    result_.loads[index(chain.load)].clear = true;
    return false;
  }

  const BrickPairs& pairs_;
  const std::vector<ChainForm>& chains_;
  LinePool pool_;
  std::vector<ChainState> chain_states_;
  std::vector<PairState> pair_states_;
  LineSchedule result_;
};

}  // namespace

LineSchedule schedule_lines(const BrickPairs& pairs, const std::vector<ChainForm>& chains,
                            int stride) {
  return Scheduler(pairs, chains, stride).run();
}

}  // namespace pounding::stiffness
