#include <gtest/gtest.h>

#include "interactions/pairing/facet_finder.h"

namespace pounding::interactions {
namespace crossing_test {

GlobalMesh two_points(const Vector3& a, const Vector3& b) {
  GlobalMesh mesh;
  mesh.coordinates = {a[0], a[1], a[2], b[0], b[1], b[2]};
  return mesh;
}

const Facet edge{{0, 1, -1, -1}, 2};
const Vector3 along_x{1, 0, 0};

std::optional<Crossing> cross(const Vector3& a, const Vector3& b, const Vector3& c,
                              const Vector3& d) {
  return cross_edges(two_points(a, b), edge, two_points(c, d), edge, along_x);
}

TEST(Crossing, TellsPlacesAndGap) {
  const auto found = cross({0, 0, 2}, {0.5, 4, 2}, {1, 1, 0}, {1, 1, 8});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->first, 0.25, 1e-15);
  EXPECT_NEAR(found->second, 0.25, 1e-15);
  EXPECT_NEAR(found->gap, 1 - 0.125, 1e-15);
  const auto swapped = cross({1, 1, 0}, {1, 1, 8}, {0, 0, 2}, {0.5, 4, 2});
  ASSERT_TRUE(swapped);
  EXPECT_NEAR(swapped->gap, -0.875, 1e-15);
}

TEST(Crossing, KnowsWhatPassesBesideAndWhatRunsAlongside) {
  EXPECT_FALSE(cross({0, 0, 2}, {0, 4, 2}, {1, 4.1, 0}, {1, 4.1, 8}));
  EXPECT_FALSE(cross({0, 0, 2}, {0, 4, 2}, {1, 1, 2.1}, {1, 1, 8}));
  EXPECT_FALSE(cross({0, 0, 2}, {0, 4, 2}, {1, 0, 2}, {1, 4, 2.3}));
  EXPECT_TRUE(cross({0, 0, 2}, {0, 4, 2}, {1, 0, 1.5}, {1, 4, 2.5}));
  EXPECT_FALSE(cross({0, 0, 2}, {4, 0, 2}, {1, 1, 0}, {1, 1, 8})) << "seen end on";
}

TEST(Crossing, SnapsToEnds) {
  const auto found = cross({0, 0, 2}, {0, 4, 2}, {1, 4 + 1e-7, 0}, {1, 4 + 1e-7, 2 - 1e-7});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->first, 1);
  EXPECT_EQ(found->second, 1);
}

}  // namespace crossing_test
}  // namespace pounding::interactions
