#include "stiffness/bricks/brick_pairs.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <tuple>

namespace pounding::stiffness {
namespace {

/// Fewer bricks on both sides of a pair are not worth a step of their own.
constexpr int least_shared = 8;

/// Runs that lie against the run before them, which ends at its chains `near` and `far`.
std::ptrdiff_t count_neighbours(const BrickRows& rows, std::size_t near, std::size_t far) {
  std::ptrdiff_t count = 0;
  for (std::size_t r = 1; r < rows.runs.size(); ++r) {
    const auto& last = rows.runs[r - 1].chain;
    const auto& next = rows.runs[r].chain;
    count += next[0] == last[near] && next[3 - near] == last[far] ? 1 : 0;
  }
  return count;
}

class PairFinder {
 public:
  /// `third`: the thickness is the second axis after that of the runs, else the first one.
  PairFinder(const BrickRows& rows, bool third) : rows_(rows) {
    const std::size_t far = third ? 2 : 1;
    const int axis = rows.run_axis, across = third ? 1 : 2;
    corners_ = {0, far, 3 - far, 3};
    result_.axes = {axis, (axis + across) % 3, (axis + 3 - across) % 3};
  }

  BrickPairs run() {
    for (std::size_t r = 0; r < rows_.runs.size(); ++r) {
      slots_.push_back(
          {find_slot(r, corners_[0], corners_[1]), find_slot(r, corners_[2], corners_[3])});
    }
    find_extents();
    find_alone();
    for (std::size_t pair = 0; pair < result_.pairs.size(); ++pair) add_steps(pair);
    return std::move(result_);
  }

 private:
  /// Where a run meets a pair: offset of its first node.
  struct Slot {
    std::size_t pair = 0;
    int offset = 0;
  };
  /// Bricks of a run from node `begin` to node `end` of a pair.
  struct Piece {
    std::size_t run = 0;
    int begin = 0;
    int end = 0;
  };
  enum End : std::size_t { first, second };  ///< of a run: the pairs before and behind its bricks

  /// The pair of two chains of a run, made known; offsets are those of the near chain.
  Slot find_slot(std::size_t run, std::size_t near, std::size_t far) {
    const auto& [shape, chain, offset, count] = rows_.runs[run];
    const int shift = offset[far] - offset[near];
    const auto [found, fresh] =
        numbers_.try_emplace({chain[near], chain[far], shift}, result_.pairs.size());
    if (fresh) {
      result_.pairs.push_back({chain[near], chain[far], offset[near], offset[far], 0, false});
    }
    ChainPair& pair = result_.pairs[found->second];
    const int begin = std::min(pair.near_begin, offset[near]);
    const int end = std::max(pair.near_begin + pair.length, offset[near] + count + 1);
    pair = {pair.near, pair.far, begin, begin + shift, end - begin, false};
    return {found->second, offset[near]};
  }

  void find_extents() {
    bricks_.resize(result_.pairs.size());
    for (std::size_t r = 0; r < rows_.runs.size(); ++r) {
      for (const End end : {first, second}) {
        Slot& slot = slots_[r][end];
        slot.offset -= result_.pairs[slot.pair].near_begin;
        bricks_[slot.pair][end].push_back({r, slot.offset, slot.offset + rows_.runs[r].count});
      }
    }
  }

  void find_alone() {
    std::vector<int> uses(rows_.chains.size(), 0);
    for (const ChainPair& pair : result_.pairs) {
      ++uses[pair.near];
      ++uses[pair.far];
    }
    for (ChainPair& pair : result_.pairs) {
      pair.alone = pair.near_begin == 0 && pair.far_begin == 0;
      for (const int chain : {pair.near, pair.far}) {
        const std::size_t c = chain;
        pair.alone = pair.alone && uses[c] == 1 &&
                     rows_.chains[c].size() == static_cast<std::size_t>(pair.length);
      }
    }
  }

  /// Bricks on both sides of a pair go together where it pays.
  void add_steps(std::size_t pair) {
    std::vector<Piece> behind = bricks_[pair][first];
    std::vector<Piece> before = bricks_[pair][second];
    while (!before.empty()) {
      const Piece piece = before.back();
      before.pop_back();
      const auto found = std::find_if(behind.begin(), behind.end(), [&](const Piece& candidate) {
        return worth_sharing(piece, candidate);
      });
      if (found == behind.end()) {
        add_step(pair, &piece, nullptr);
        continue;
      }
      const Piece other = *found;
      behind.erase(found);
      const int begin = std::max(piece.begin, other.begin);
      const int end = std::min(piece.end, other.end);
      const Piece shared_before{piece.run, begin, end};
      const Piece shared_behind{other.run, begin, end};
      add_step(pair, &shared_before, &shared_behind);
      add_rest(piece, begin, end, before);
      add_rest(other, begin, end, behind);
    }
    for (const Piece& piece : behind) add_step(pair, nullptr, &piece);
  }

  bool worth_sharing(const Piece& a, const Piece& b) const {
    if (rows_.runs[a.run].shape != rows_.runs[b.run].shape) return false;
    const int shared = std::min(a.end, b.end) - std::max(a.begin, b.begin);
    return shared >= least_shared || (a.begin == b.begin && a.end == b.end);
  }

  static void add_rest(const Piece& piece, int begin, int end, std::vector<Piece>& rest) {
    if (piece.begin < begin) rest.push_back({piece.run, piece.begin, begin});
    if (end < piece.end) rest.push_back({piece.run, end, piece.end});
  }

  /// Bricks before the pair, behind it, or both.
  void add_step(std::size_t pair, const Piece* before, const Piece* behind) {
    const Piece& piece = before != nullptr ? *before : *behind;
    PairStep step;
    step.shape = rows_.runs[piece.run].shape;
    step.sides = before == nullptr   ? Sides::behind
                 : behind == nullptr ? Sides::before
                                     : Sides::both;
    step.pair[0] = static_cast<int>(pair);
    step.offset[0] = piece.begin;
    step.count = piece.end - piece.begin;
    if (before != nullptr) set_neighbour(*before, first, step.pair[1], step.offset[1]);
    if (behind != nullptr) set_neighbour(*behind, second, step.pair[2], step.offset[2]);
    result_.steps.push_back(step);
  }

  /// The pair at the given end of a piece's run, and where the piece meets it.
  void set_neighbour(const Piece& piece, End end, int& pair, int& offset) const {
    const auto& slots = slots_[piece.run];
    const Slot& own = slots[end == first ? second : first];
    pair = static_cast<int>(slots[end].pair);
    offset = slots[end].offset + piece.begin - own.offset;
  }

  const BrickRows& rows_;
  std::array<std::size_t, 4> corners_{};  ///< slots in ElementRun::chain: near, far, near, far
  std::map<std::tuple<int, int, int>, std::size_t> numbers_;
  std::vector<std::array<Slot, 2>> slots_;                 ///< per run
  std::vector<std::array<std::vector<Piece>, 2>> bricks_;  ///< per pair: at which end of the run
  BrickPairs result_;
};

}  // namespace

BrickPairs pair_chains(const BrickRows& rows) {
  BrickPairs third = PairFinder(rows, true).run();
  BrickPairs second = PairFinder(rows, false).run();
  const auto clearly_fewer = [](const BrickPairs& a, const BrickPairs& b) {
    return 10 * a.steps.size() < 9 * b.steps.size();
  };
  if (clearly_fewer(third, second)) return third;
  if (clearly_fewer(second, third)) return second;
  return count_neighbours(rows, 1, 3) >= count_neighbours(rows, 2, 3) ? third : second;
}

}  // namespace pounding::stiffness
