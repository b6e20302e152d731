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

TEST(ImpactCatalogue, ContinuesAnOpenEpisode) {
  const auto make = [] {
    return ImpactCatalogue(2, {0, 0, 1}, {{0.0, 1.0}, {2.0, 1.0}, {5.0, 5.0}}, 0.01);
  };
  const auto add = [](ImpactCatalogue& catalogue, double time, double first, double third) {
    const std::vector<double> gaps{-1e-6, -2e-6, -3e-6};
    const std::vector<double> impulses{first, 1, third};
    const std::vector<double> works{-0.5 * first, -0.25, 0.1};
    catalogue.add_step(time, 0.001, gaps, impulses, works);
  };
  ImpactCatalogue whole = make();
  ImpactCatalogue before = make();
  for (ImpactCatalogue* catalogue : {&whole, &before}) {
    add(*catalogue, 1, 3, 0);
    add(*catalogue, 2, 2, 4);
  }
  SavedState saved;
  before.save(saved);
  ImpactCatalogue after = make();
  after.load(saved);
  EXPECT_EQ(after.episodes(), 3);
  for (ImpactCatalogue* catalogue : {&whole, &after}) {
    add(*catalogue, 2.001, 5, 0);
    add(*catalogue, 3, 0, 7);
    catalogue->finish(MPI_COMM_SELF, 0);
  }
  ASSERT_EQ(whole.impacts().size(), 5u);
  ASSERT_EQ(after.impacts().size(), whole.impacts().size());
  for (std::size_t i = 0; i < whole.impacts().size(); ++i) {
    const Impact& one = whole.impacts()[i];
    const Impact& other = after.impacts()[i];
    EXPECT_EQ(one.contact, other.contact);
    EXPECT_EQ(one.start, other.start);
    EXPECT_EQ(one.end, other.end);
    EXPECT_EQ(one.impulse, other.impulse);
    EXPECT_EQ(one.peak_force, other.peak_force);
    EXPECT_EQ(one.points, other.points);
    EXPECT_EQ(one.energy_lost, other.energy_lost);
    EXPECT_EQ(one.max_penetration, other.max_penetration);
    EXPECT_EQ(one.place, other.place);
  }
}

}  // namespace
}  // namespace pounding
