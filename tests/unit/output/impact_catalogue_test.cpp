#include "output/impact_catalogue.h"

#include <gtest/gtest.h>

namespace pounding {
namespace {

TEST(ImpactCatalogue, MergesContactsWithinTheMergeTimeAndSeparatesOthers) {
  ImpactCatalogue catalogue(1, {0, 0}, {{0.0, 1.0}, {2.0, 1.0}}, 0.01);
  const auto add = [&](double time, double first, double second) {
    const std::vector<double> gaps{-1e-6, -2e-6};
    const std::vector<double> impulses{first, second};
    const std::vector<double> works{-0.5 * first, 0};
    catalogue.add_step(time, 0.001, gaps, impulses, works);
  };
  add(1.000, 3, 0);
  add(1.005, 0, 1);
  add(2.000, 2, 2);
  catalogue.finish(MPI_COMM_SELF, 0);
  ASSERT_EQ(catalogue.impacts().size(), 2u);
  const Impact& first = catalogue.impacts()[0];
  EXPECT_DOUBLE_EQ(first.impulse, 4);
  EXPECT_DOUBLE_EQ(first.start, 1.0);
  EXPECT_DOUBLE_EQ(first.end, 1.006);
  EXPECT_EQ(first.points, 2);
  EXPECT_DOUBLE_EQ(first.energy_lost, 1.5);
  EXPECT_DOUBLE_EQ(first.peak_force, 3000);
  EXPECT_DOUBLE_EQ(first.place[0], 0.5);  // (3 * 0 + 1 * 2) / 4
  EXPECT_DOUBLE_EQ(first.max_penetration, 2e-6);
  EXPECT_EQ(catalogue.impacts()[1].points, 2);
  EXPECT_EQ(catalogue.totals().episodes, 2);
  EXPECT_DOUBLE_EQ(catalogue.totals().largest_impulse, 4);
}

}  // namespace
}  // namespace pounding
