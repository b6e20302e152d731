#include "stiffness/rows/element_rows.h"

#include <gtest/gtest.h>

#include "unit/stiffness/brick_grid.h"

namespace pounding::stiffness {
namespace element_rows_test {

using testing_support::grid;

TEST(ElementRows, AGridHasOneRunPerRow) {
  const auto bricks = grid(5, 3, 2);
  const BrickRows along_x = find_rows(bricks, 6 * 4 * 3, 0);
  EXPECT_EQ(along_x.chains.size(), 4u * 3u);
  ASSERT_EQ(along_x.runs.size(), 3u * 2u);
  EXPECT_EQ(along_x.runs[0].count, 5);
  EXPECT_EQ(along_x.runs[0].chain, (std::array<int, 4>{0, 1, 4, 5}));
  EXPECT_EQ(along_x.chains[1], (std::vector<LocalIndex>{6, 7, 8, 9, 10, 11}));
  const BrickRows along_z = find_rows(bricks, 6 * 4 * 3, 2);
  EXPECT_EQ(along_z.chains.size(), 6u * 4u);
  EXPECT_EQ(along_z.runs.size(), 5u * 3u);
}

TEST(ElementRows, AnotherShapeStartsARunOnTheSameChains) {
  auto bricks = grid(6, 1, 1);
  bricks[2].shape = 1;
  bricks[3].shape = 1;
  const BrickRows rows = find_rows(bricks, 7 * 4, 0);
  EXPECT_EQ(rows.chains.size(), 4u);
  ASSERT_EQ(rows.runs.size(), 3u);
  EXPECT_EQ(rows.runs[1].shape, 1);
  EXPECT_EQ(rows.runs[1].count, 2);
  EXPECT_EQ(rows.runs[1].offset[3], 2);
}

TEST(ElementRows, AHoleCutsARun) {
  auto bricks = grid(5, 1, 1);
  bricks.erase(bricks.begin() + 2);
  const BrickRows rows = find_rows(bricks, 6 * 4, 0);
  EXPECT_EQ(rows.chains.size(), 8u);
  ASSERT_EQ(rows.runs.size(), 2u);
  EXPECT_EQ(rows.runs[0].count + rows.runs[1].count, 4);
  EXPECT_TRUE(rows.left_over.empty());
}

/// Two bricks claim different successors of one node: the second is left over, nothing is lost.
TEST(ElementRows, WhatDoesNotConformIsLeftOver) {
  auto bricks = grid(2, 1, 1);
  BrickElement hanging = bricks[0];
  hanging.nodes[1] = 12;  // another far end of the edge from node 0
  bricks.push_back(hanging);
  const BrickRows rows = find_rows(bricks, 13, 0);
  EXPECT_EQ(rows.left_over, (std::vector<std::size_t>{2}));
  ASSERT_EQ(rows.runs.size(), 1u);
  EXPECT_EQ(rows.runs[0].count, 2);
}

TEST(ElementRows, TheBestRowsAreTheLongOnes) {
  EXPECT_EQ(best_rows(grid(16, 2, 1), 17 * 3 * 2).run_axis, 0);
  EXPECT_EQ(best_rows(grid(1, 2, 16), 2 * 3 * 17).run_axis, 2);
}

}  // namespace element_rows_test
}  // namespace pounding::stiffness
