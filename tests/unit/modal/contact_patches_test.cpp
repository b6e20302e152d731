#include <gtest/gtest.h>

#include "modal/static_loads.h"

namespace pounding {
namespace contact_patches_test {

using Patches = std::vector<std::vector<std::size_t>>;

struct Points {
  std::vector<TracePoint> points;
  std::vector<Vector3> positions;

  void add(int component, const Vector3& place) {
    points.push_back({static_cast<GlobalIndex>(points.size()), component});
    positions.push_back(place);
  }
  Patches patches(std::size_t count) const { return contact_patches(points, positions, count); }
};

Points line(int count, int component = 0) {
  Points line;
  for (int i = 0; i < count; ++i) line.add(component, {0, 0.5 * i, 1});
  return line;
}

TEST(ContactPatches, AreNeighbours) {
  EXPECT_EQ(line(10).patches(2), (Patches{{0, 1, 2, 3, 4}, {5, 6, 7, 8, 9}}));
  EXPECT_EQ(line(9).patches(1), (Patches{{0, 1, 2, 3, 4, 5, 6, 7, 8}}));
}

TEST(ContactPatches, AsManyAsPointsAreThePoints) {
  const Patches single = line(7).patches(7);
  ASSERT_EQ(single.size(), 7U);
  for (const auto& patch : single) EXPECT_EQ(patch.size(), 1U);
}

TEST(ContactPatches, DoNotMixAxes) {
  Points points = line(8);
  for (int i = 0; i < 4; ++i) points.add(2, {0, 0.5 * i, 1});
  const Patches patches = points.patches(3);
  ASSERT_EQ(patches.size(), 3U);
  for (const auto& patch : patches) {
    for (const std::size_t p : patch) {
      EXPECT_EQ(points.points[p].component, points.points[patch.front()].component);
    }
  }
  // A few points of an axis of their own have one all the same.
  points.add(1, {0, 0, 1});
  EXPECT_EQ(points.patches(2).size(), 3U);
}

TEST(ContactPatches, HoldEveryPointOnce) {
  Points grid;
  for (int i = 0; i < 13; ++i) {
    for (int j = 0; j < 11; ++j) grid.add(i % 2, {0.3 * i, 0.2 * j * j, 0.1 * i * j});
  }
  const Patches patches = grid.patches(12);
  std::vector<int> times(grid.points.size(), 0);
  for (const auto& patch : patches) {
    EXPECT_FALSE(patch.empty());
    for (const std::size_t p : patch) ++times[p];
  }
  EXPECT_EQ(times, std::vector<int>(times.size(), 1));
  EXPECT_EQ(grid.patches(12), patches);
}

TEST(ContactPatches, OfPointsInOnePlaceAreOne) {
  Points points;
  for (int i = 0; i < 5; ++i) points.add(0, {1, 2, 3});
  EXPECT_EQ(points.patches(3), (Patches{{0, 1, 2, 3, 4}}));
}

}  // namespace contact_patches_test
}  // namespace pounding
