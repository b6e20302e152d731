#include "common/integer_sets.h"

#include <cstdlib>
#include <limits>
#include <set>

#include <gtest/gtest.h>

namespace pounding {
namespace integer_sets_test {

TEST(NumberSet, IsAnOrderedSet) {
  NumberSet set;
  std::set<std::int64_t> expected;
  std::srand(7);
  const auto add = [&](std::int64_t number) {
    EXPECT_EQ(set.insert(number), expected.insert(number).second) << number;
  };
  for (std::int64_t i = 1; i < 3000; ++i) add(i);
  for (int i = 0; i < 3000; ++i) add(std::rand() % 20000 - 10000);
  for (const std::int64_t edge :
       {std::numeric_limits<std::int64_t>::min(), std::int64_t{-1}, std::int64_t{511},
        std::int64_t{512}, std::int64_t{1} << 40, std::numeric_limits<std::int64_t>::max()}) {
    add(edge);
    add(edge);
  }
  const std::vector<std::int64_t> sorted = set.sort();
  EXPECT_EQ(sorted, std::vector<std::int64_t>(expected.begin(), expected.end()));
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    EXPECT_EQ(set.index(sorted[i]), static_cast<std::int64_t>(i));
    EXPECT_TRUE(set.contains(sorted[i]));
  }
  for (int i = 0; i < 3000; ++i) {
    const std::int64_t number = std::rand() % 40000 - 20000;
    if (expected.contains(number)) continue;
    EXPECT_EQ(set.index(number), -1) << number;
    EXPECT_FALSE(set.contains(number)) << number;
  }
}

TEST(NumberSet, EmptyHasNoNumbers) {
  NumberSet set;
  EXPECT_TRUE(set.sort().empty());
  EXPECT_EQ(set.index(0), -1);
}

}  // namespace integer_sets_test
}  // namespace pounding
