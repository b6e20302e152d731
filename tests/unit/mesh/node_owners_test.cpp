#include <vector>

#include <gtest/gtest.h>

#include "mesh/element_graph.h"

namespace pounding {
namespace node_owners_test {

/// Nodes with these elements.
NodeElements nodes(const std::vector<std::vector<idx_t>>& elements) {
  NodeElements at;
  at.first.push_back(0);
  for (const std::vector<idx_t>& of_node : elements) {
    at.elements.insert(at.elements.end(), of_node.begin(), of_node.end());
    at.first.push_back(at.elements.size());
  }
  return at;
}

TEST(NodeOwners, TheMostElementsDecide) {
  const std::vector<idx_t> owner{0, 1, 1}, cost{1, 1, 1};
  EXPECT_EQ(node_owners(nodes({{0}, {1}, {0, 1, 2}, {0, 0, 1}}), owner, cost, 2),
            (std::vector<int>{0, 1, 1, 0}));
}

TEST(NodeOwners, ACutGoesToTheLighterPartAsAWhole) {
  const std::vector<idx_t> owner{0, 1}, cost{3, 2};
  EXPECT_EQ(node_owners(nodes({{0, 1}, {1, 0}, {0, 1}}), owner, cost, 2),
            (std::vector<int>{1, 1, 1}));
}

TEST(NodeOwners, OfEqualPartsTheLowerTakesIt) {
  const std::vector<idx_t> owner{1, 0}, cost{2, 2};
  EXPECT_EQ(node_owners(nodes({{0, 1}, {1, 0}}), owner, cost, 2), (std::vector<int>{0, 0}));
}

// A row of three parts: the longer cut, at the right, is dealt out first, and its load counts then.
TEST(NodeOwners, TheLongestCutIsDealtOutFirst) {
  const std::vector<idx_t> owner{0, 1, 2}, cost{10, 10, 10};
  const NodeElements at = nodes({{0}, {0, 1}, {1, 2}, {1, 2}, {2}});
  EXPECT_EQ(node_owners(at, owner, cost, 3), (std::vector<int>{0, 0, 1, 1, 2}));
  const std::vector<idx_t> left{11, 10, 10};
  EXPECT_EQ(node_owners(at, owner, left, 3), (std::vector<int>{0, 0, 1, 1, 2}));
  const std::vector<idx_t> middle{10, 11, 10};
  EXPECT_EQ(node_owners(at, owner, middle, 3), (std::vector<int>{0, 0, 2, 2, 2}));
}

}  // namespace node_owners_test
}  // namespace pounding
