#include "observers/impact_catalogue.h"

#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "../motion/motion_files.h"

namespace pounding {
namespace impact_catalogue_test {

constexpr ImpactTimes times{0.01, 2e-3, 1e-3};

TEST(ImpactCatalogue, MergesContactsWithinTheMergeTimeAndSeparatesOthers) {
  ImpactCatalogue catalogue(1, {0, 0}, {{0.0, 1.0}, {2.0, 1.0}}, times);
  const auto add = [&](double time, double first, double second) {
    const std::vector<double> gaps{-1e-6, -2e-6};
    const std::vector<double> impulses{first, second};
    const std::vector<double> works{-0.5 * first, 0};
    catalogue.add_step(time, 0.001, {gaps, impulses, works});
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
  EXPECT_DOUBLE_EQ(first.window_force, 1500);
  EXPECT_DOUBLE_EQ(first.place[0], 0.5);  // (3 * 0 + 1 * 2) / 4
  EXPECT_DOUBLE_EQ(first.max_penetration, 2e-6);
  EXPECT_DOUBLE_EQ(first.contact_time, 0.002);  // of the 0.006 from its start to its end
  EXPECT_DOUBLE_EQ(first.low_share[0], 0.75);   // 3 of 4 at the low end of the first axis
  EXPECT_DOUBLE_EQ(first.low_share[1], 0.5);    // no extent along the second
  EXPECT_EQ(catalogue.impacts()[1].points, 2);
  EXPECT_EQ(catalogue.totals().episodes, 2);
  EXPECT_DOUBLE_EQ(catalogue.totals().largest_impulse, 4);
}

TEST(ImpactCatalogue, MergesAcrossSilencesUpToTheMergeTimeAndNoLonger) {
  const auto episodes = [](double silence) {
    ImpactCatalogue catalogue(1, {0}, {{0.0, 0.0}}, times);
    const std::vector<double> none{0.0};
    const std::vector<double> one{1.0};
    catalogue.add_step(1, 0.001, {none, one, none});
    catalogue.add_step(1.001 + silence, 0.001, {none, one, none});
    catalogue.finish(MPI_COMM_SELF, 0);
    return catalogue.impacts().size();
  };
  EXPECT_EQ(episodes(0.0099), 1u);
  EXPECT_EQ(episodes(0.0101), 2u);
}

TEST(ImpactCatalogue, ContinuesAnOpenEpisode) {
  const auto make = [] {
    return ImpactCatalogue(2, {0, 0, 1}, {{0.0, 1.0}, {2.0, 1.0}, {5.0, 5.0}}, times);
  };
  const auto add = [](ImpactCatalogue& catalogue, double time, double first, double third) {
    const std::vector<double> gaps{-1e-6, -2e-6, -3e-6};
    const std::vector<double> impulses{first, 1, third};
    const std::vector<double> works{-0.5 * first, -0.25, 0.1};
    catalogue.add_step(time, 0.001, {gaps, impulses, works});
  };
  ImpactCatalogue whole = make();
  ImpactCatalogue before = make();
  for (ImpactCatalogue* catalogue : {&whole, &before}) {
    add(*catalogue, 1, 3, 0);
    add(*catalogue, 2, 2, 4);
  }
  SavedState saved;
  before.keep(StateKeeper::to(saved), MPI_COMM_SELF, 0);
  ImpactCatalogue after = make();
  after.keep(StateKeeper::from(saved), MPI_COMM_SELF, 0);
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
    EXPECT_EQ(one.window_force, other.window_force);
    EXPECT_EQ(one.points, other.points);
    EXPECT_EQ(one.energy_lost, other.energy_lost);
    EXPECT_EQ(one.max_penetration, other.max_penetration);
    EXPECT_EQ(one.place, other.place);
    EXPECT_EQ(one.contact_time, other.contact_time);
    EXPECT_EQ(one.low_share, other.low_share);
  }
}

TEST(ImpactCatalogue, TellsTheHalvesOfEachFaceApart) {
  // A face of 3 x 2 points, and a lone point that belongs to another contact.
  std::vector<std::array<double, 2>> places;
  std::vector<int> contact_of_row;
  for (const double y : {0.0, 1.0, 2.0}) {
    for (const double z : {5.0, 5.2}) {
      places.push_back({y, z});
      contact_of_row.push_back(1);
    }
  }
  places.push_back({100.0, 100.0});
  contact_of_row.push_back(0);
  ImpactCatalogue catalogue(2, contact_of_row, places, times);
  const std::vector<double> none(7, 0.0);
  catalogue.add_step(1, 1e-3, {none, std::vector<double>{1, 0, 2, 4, 0, 1, 0}, none});
  catalogue.add_step(3, 1e-3, {none, std::vector<double>{0, 0, 0, 0, 0, 0, 5}, none});
  catalogue.finish(MPI_COMM_SELF, 0);
  ASSERT_EQ(catalogue.impacts().size(), 2u);
  EXPECT_DOUBLE_EQ(catalogue.impacts()[0].low_share[0], (1 + 0.5 * 6) / 8);
  EXPECT_DOUBLE_EQ(catalogue.impacts()[0].low_share[1], 3.0 / 8);
  EXPECT_DOUBLE_EQ(catalogue.impacts()[1].low_share[0], 0.5);
}

class ImpactFile : public testing_support::MotionFiles {};

TEST_F(ImpactFile, IsReadBackAsItWasWritten) {
  Impact impact;
  impact.contact = 1;
  impact.start = 1.0 / 3;
  impact.end = 0.34;
  impact.impulse = 2;
  const std::string path = (folder_ / "impacts.csv").string();
  write_impacts(path, {"floor1", "floor2"}, std::vector<Impact>{impact, impact}, 17);
  const auto windows = read_impact_windows(path);
  ASSERT_EQ(windows.size(), 2u);
  EXPECT_EQ(windows[1].contact, "floor2");
  EXPECT_EQ(windows[1].start, impact.start);
  EXPECT_EQ(windows[1].end, impact.end);
}

TEST(ImpactCatalogue, AddsFrictionUpAndForgetsPathsOfEarlierEpisodes) {
  ImpactCatalogue catalogue(1, {0, 0}, {{0, 0}, {1, 0}}, times);
  const std::vector<double> none{0, 0};
  const std::vector<double> impulses{2, 0};
  const std::vector<Vector3> tangential{{0, 0, -1}, {0, 0, 0}};
  const std::vector<double> slips{3, 5};  // the second point does not touch
  const std::vector<double> losses{7, 0};
  for (const double time : {0.0, 0.5, 2.0}) {  // the last two are episodes of their own
    for (int step = 0; step < 2; ++step) {
      catalogue.add_step(time + 1e-3 * step, 1e-3,
                         {none, impulses, none, tangential, slips, losses});
    }
  }
  catalogue.finish(MPI_COMM_SELF, 0);
  ASSERT_EQ(catalogue.impacts().size(), 3u);
  for (const Impact& impact : catalogue.impacts()) {
    EXPECT_EQ(impact.tangential_impulse, 2);
    EXPECT_NEAR(impact.slip, 6e-3, 1e-17);
    EXPECT_EQ(impact.friction_loss, 14);
  }
  EXPECT_EQ(catalogue.totals().friction_loss, 42);
}

TEST_F(ImpactFile, EveryNumberStandsUnderItsName) {
  Impact impact{0, 1, 3, 5, 7, 11, 13, 17, {19, 23}, 29, {31, 37}, 41, 43, 47, 53};
  const std::string path = (folder_ / "impacts.csv").string();
  write_impacts(path, {"floor"}, std::vector<Impact>{impact}, 9);
  std::ifstream file(path);
  std::string names;
  std::getline(file, names);
  std::string numbers;
  std::getline(file, numbers);
  EXPECT_EQ(names,
            "contact,start,end,duration,impulse,peak_force,points,energy_lost,max_penetration,"
            "lateral,vertical,contact_time,left,bottom,tangential_impulse,slip,friction_loss,"
            "window_force");
  EXPECT_EQ(numbers, "floor,1,3,2,5,7,11,13,17,19,23,29,31,37,41,43,47,53");
}

TEST_F(ImpactFile, RefusesWhatIsNoCatalogue) {
  const auto refused = [&](const std::string& text) {
    return testing_support::refusal([&] { read_impact_windows(write("impacts.csv", text)); });
  };
  EXPECT_NE(refused("time,start,end\n").find("contact,start,end"), std::string::npos);
  EXPECT_NE(refused("contact,start,end\nroof,1,x\n").find("impacts.csv:2"), std::string::npos);
  EXPECT_NE(refused("contact,start,end\nroof,1,0.5\n").find("later end"), std::string::npos);
  EXPECT_NE(refused("contact,start,end\nroof,1\n").find("no impact"), std::string::npos);
}

}  // namespace impact_catalogue_test
}  // namespace pounding
