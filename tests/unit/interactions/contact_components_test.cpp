#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "interactions/delassus.h"

namespace pounding::interactions {
namespace contact_components_test {

using Groups = std::vector<std::vector<int>>;

TEST(ContactComponents, MatchedNodePairsStandAlone) {
  EXPECT_EQ(coupled_components(Groups{{0, 4}, {1, 5}, {2, 6}}, 8), (Groups{{0}, {1}, {2}}));
}

TEST(ContactComponents, NodesOnOneFaceAreOneGroup) {
  // Three nodes 0..2 against the edge 3-4: the corner rows meet through the middle one.
  EXPECT_EQ(coupled_components(Groups{{0, 3}, {1, 3, 4}, {2, 4}}, 5), (Groups{{0, 1, 2}}));
}

TEST(ContactComponents, GroupsFollowTheirFirstRowAndRowsAscend) {
  // Rows 4 and 1 meet late, through row 5; row 2 has no dof.
  const Groups rows{{9}, {1, 2}, {}, {7, 8}, {5, 6}, {2, 5}, {8}};
  EXPECT_EQ(coupled_components(rows, 10), (Groups{{0}, {1, 4, 5}, {2}, {3, 6}}));
}

TEST(ContactComponents, LongChainsInAnyOrderAreOneGroup) {
  const int links = 2000;
  Groups rows;
  std::vector<int> all;
  for (int k = 0; k < links; ++k) {
    const int link = (k * 1237) % links;  // 1237 and 2000 have no common factor
    rows.push_back({link, link + 1});
    all.push_back(k);
  }
  EXPECT_EQ(coupled_components(rows, links + 1), Groups{all});
}

TEST(ContactComponents, NoRowsGiveNoGroups) {
  EXPECT_TRUE(coupled_components(Groups{}, 3).empty());
}

TEST(ContactComponents, ADofOutOfRangeIsRefused) {
  EXPECT_THROW(coupled_components(Groups{{0, 3}}, 3), std::invalid_argument);
  EXPECT_THROW(coupled_components(Groups{{-1}}, 3), std::invalid_argument);
}

}  // namespace contact_components_test
}  // namespace pounding::interactions
