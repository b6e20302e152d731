#include "stiffness/bricks/brick_pairs.h"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "unit/stiffness/brick_grid.h"

namespace pounding::stiffness {
namespace brick_pairs_test {

using testing_support::grid;

int count_sides(const BrickPairs& pairs, Sides sides) {
  return static_cast<int>(std::count_if(pairs.steps.begin(), pairs.steps.end(),
                                        [&](const PairStep& step) { return step.sides == sides; }));
}

/// A brick by its eight nodes: near then far chain, before then behind, near end then far end.
using Nodes = std::vector<LocalIndex>;

/// How often each brick is done for the pair before it and for the one behind it.
std::map<std::pair<int, Nodes>, std::array<int, 2>> bricks_done(const BrickRows& rows,
                                                                const BrickPairs& pairs) {
  std::map<std::pair<int, Nodes>, std::array<int, 2>> done;
  const auto node = [&](int pair, int place, bool far) {
    const ChainPair& p = pairs.pairs[static_cast<std::size_t>(pair)];
    const auto& chain = rows.chains[static_cast<std::size_t>(far ? p.far : p.near)];
    return chain.at(static_cast<std::size_t>(place + (far ? p.far_begin : p.near_begin)));
  };
  for (const PairStep& step : pairs.steps) {
    for (const bool behind : {false, true}) {
      const std::size_t other = behind ? 2 : 1;
      if (step.pair[other] < 0) continue;
      const std::size_t low = behind ? 0 : other;
      const std::size_t high = behind ? other : 0;
      for (int i = 0; i < step.count; ++i) {
        Nodes nodes;
        for (const std::size_t line : {low, high})
          for (const bool far : {false, true})
            for (const int end : {0, 1})
              nodes.push_back(node(step.pair[line], step.offset[line] + i + end, far));
        std::sort(nodes.begin(), nodes.end());
        ++done[{step.shape, nodes}][behind ? 0 : 1];
      }
    }
  }
  return done;
}

void expect_each_brick_once(const std::vector<BrickElement>& bricks, LocalIndex nodes) {
  for (int axis = 0; axis < 3; ++axis) {
    const BrickRows rows = find_rows(bricks, nodes, axis);
    const auto done = bricks_done(rows, pair_chains(rows));
    EXPECT_EQ(done.size(), bricks.size());
    for (const BrickElement& brick : bricks) {
      Nodes corners(brick.nodes.begin(), brick.nodes.end());
      std::sort(corners.begin(), corners.end());
      const auto found = done.find({brick.shape, corners});
      ASSERT_NE(found, done.end());
      EXPECT_EQ(found->second, (std::array<int, 2>{1, 1}));
    }
  }
}

TEST(BrickPairs, ASlabHasAPairPerRowOfNodes) {
  const BrickRows rows = find_rows(grid(7, 5, 1), 8 * 6 * 2, 0);
  const BrickPairs pairs = pair_chains(rows);
  EXPECT_EQ(pairs.axes, (std::array<int, 3>{0, 1, 2}));
  ASSERT_EQ(pairs.pairs.size(), 6u);
  EXPECT_TRUE(pairs.pairs[3].alone);
  EXPECT_EQ(pairs.pairs[3].length, 8);
  EXPECT_EQ(pairs.steps.size(), 6u);
  EXPECT_EQ(count_sides(pairs, Sides::both), 4);
}

TEST(BrickPairs, TheThicknessIsFoundOnAnyAxis) {
  EXPECT_EQ(pair_chains(find_rows(grid(7, 1, 5), 8 * 2 * 6, 0)).axes,
            (std::array<int, 3>{0, 2, 1}));
  EXPECT_EQ(pair_chains(find_rows(grid(1, 5, 7), 2 * 6 * 8, 2)).axes,
            (std::array<int, 3>{2, 1, 0}));
}

TEST(BrickPairs, LayersShareChains) {
  const BrickPairs pairs = pair_chains(find_rows(grid(7, 5, 2), 8 * 6 * 3, 0));
  EXPECT_EQ(pairs.pairs.size(), 12u);
  EXPECT_EQ(pairs.steps.size(), 12u);
  EXPECT_TRUE(std::none_of(pairs.pairs.begin(), pairs.pairs.end(),
                           [](const ChainPair& pair) { return pair.alone; }));
}

/// In a block a step more or less does not matter: pairs follow each other as the runs do.
TEST(BrickPairs, ABlockIsDoneInTheOrderOfItsRuns) {
  const std::array<int, 3> in_order{0, 1, 2};
  EXPECT_EQ(pair_chains(find_rows(grid(10, 12, 11), 11 * 13 * 12, 0)).axes, in_order);
  EXPECT_EQ(pair_chains(find_rows(grid(10, 11, 12), 11 * 12 * 13, 0)).axes, in_order);
}

/// A longer row on a shorter one: what they share goes together, the rest apart.
TEST(BrickPairs, RowsOfTwoLengths) {
  auto bricks = grid(20, 2, 1);
  bricks.erase(bricks.begin() + 32, bricks.begin() + 40);
  const BrickPairs pairs = pair_chains(find_rows(bricks, 21 * 3 * 2, 0));
  ASSERT_EQ(count_sides(pairs, Sides::both), 1);
  const auto both = std::find_if(pairs.steps.begin(), pairs.steps.end(),
                                 [](const PairStep& step) { return step.sides == Sides::both; });
  EXPECT_EQ(both->count, 12);
  EXPECT_EQ(count_sides(pairs, Sides::before), 2);
  expect_each_brick_once(bricks, 21 * 3 * 2);
}

TEST(BrickPairs, EachBrickActsOnceOnEachSide) {
  expect_each_brick_once(grid(4, 3, 2), 5 * 4 * 3);
  expect_each_brick_once(grid(1, 1, 1), 8);
  auto holes = grid(13, 7, 3);
  for (std::size_t b = 0; b < holes.size(); b += 1 + b % 5) holes[b].shape = 1;
  for (std::size_t b = 3; b < holes.size(); b += 11 - b % 7) {
    holes.erase(holes.begin() + static_cast<std::ptrdiff_t>(b));
  }
  expect_each_brick_once(holes, 14 * 8 * 4);
}

}  // namespace brick_pairs_test
}  // namespace pounding::stiffness
