#include <random>

#include <gtest/gtest.h>

#include "common/integer_sets.h"

namespace pounding {
namespace disjoint_sets_test {

TEST(DisjointSets, BeginAsOneSetForEachNumber) {
  DisjointSets sets(3);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(sets.root(i), i);
}

TEST(DisjointSets, AreNamedByTheirSmallestMemberHoweverTheyWereJoined) {
  std::vector<std::size_t> order(50);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    std::shuffle(order.begin(), order.end(), random);
    DisjointSets sets(50);
    // Numbers with the same remainder by 7 belong together.
    for (const std::size_t i : order) {
      if (i >= 7) sets.join(i, i - 7);
    }
    for (std::size_t i = 0; i < 50; ++i) EXPECT_EQ(sets.root(i), i % 7);
  }
}

}  // namespace disjoint_sets_test
}  // namespace pounding
