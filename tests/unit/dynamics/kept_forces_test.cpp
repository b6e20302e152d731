#include "dynamics/kept_forces.h"

#include <numeric>

#include <gtest/gtest.h>

namespace pounding {
namespace kept_forces_test {

/// A force of its own at every dof.
std::vector<double> numbered(std::size_t count) {
  std::vector<double> force(count);
  std::iota(force.begin(), force.end(), 100.0);
  return force;
}

void hand_over(KeptForces<double>& kept, const std::vector<double>& force, std::size_t length,
               const Filters<double>& filters = {0, 1, {}},
               std::span<const std::vector<double>> memories = {},
               std::span<const double> inelastic = {}) {
  // The last range first: ranges come in any order.
  const std::size_t ranges = (force.size() + length - 1) / length;
  for (std::size_t r = ranges; r-- > 0;) {
    const std::size_t begin = r * length, end = std::min(begin + length, force.size());
    kept.take(static_cast<LocalIndex>(begin), static_cast<LocalIndex>(end), &force[begin],
              inelastic, filters, memories);
  }
}

TEST(KeptForces, HoldsThoseOfTheWatchedDofsInRangesOfAnyLength) {
  for (const std::size_t count : {1, 15, 16, 17, 32, 47, 100}) {
    const std::vector<double> force = numbered(count);
    for (const std::size_t length : {1, 3, 16, 40, 100}) {
      KeptForces<double> kept(count);
      EXPECT_TRUE(kept.none());
      std::vector<LocalIndex> dofs;
      for (std::size_t i = 0; i < count; i += 1 + i % 7) {
        dofs.insert(dofs.begin(), static_cast<LocalIndex>(i));  // in no order
      }
      const std::vector<LocalIndex> last{static_cast<LocalIndex>(count) - 1};
      kept.watch(dofs);
      kept.watch(last);  // perhaps watched already
      EXPECT_FALSE(kept.none());
      hand_over(kept, force, length);
      dofs.push_back(last.front());
      for (const LocalIndex dof : dofs) {
        EXPECT_EQ(kept.at(dof).stiffness, 100.0 + dof) << count << " in " << length;
        EXPECT_EQ(kept.at(dof).acting, 100.0 + dof);
      }
    }
  }
}

TEST(KeptForces, FiltersByTheMemoriesBeforeTheStep) {
  const std::vector<double> force = numbered(20);
  const Filters<double> filters{2, 1.5, {{{0.25, 0, 0}, {0.5, 0, 0}}}};
  const std::vector<std::vector<double>> memories{std::vector<double>(20, 8.0), numbered(20)};
  KeptForces<double> kept(20);
  const std::vector<LocalIndex> dofs{3, 19};
  kept.watch(dofs);
  hand_over(kept, force, 6, filters, memories);
  EXPECT_EQ(kept.at(3).stiffness, 103);
  EXPECT_EQ(kept.at(3).acting, 1.5 * 103 - 0.25 * 8 - 0.5 * 103);
  EXPECT_EQ(kept.at(19).acting, 1.5 * 119 - 0.25 * 8 - 0.5 * 119);
}

TEST(KeptForces, FiltersForcesOfInelasticElementsAsWell) {
  const std::vector<double> force = numbered(4);
  const std::vector<double> inelastic{1, 2, 3, 4};
  const Filters<double> filters{1, 1.5, {{{0.25, 0, 0}}}};
  const std::vector<std::vector<double>> memories{std::vector<double>(4, 8.0)};
  KeptForces<double> kept(4);
  const std::vector<LocalIndex> dofs{2};
  kept.watch(dofs);
  hand_over(kept, force, 4, filters, memories, inelastic);
  EXPECT_EQ(kept.at(2).stiffness, 102);
  EXPECT_DOUBLE_EQ(kept.at(2).acting, 1.5 * (102 + 3) - 0.25 * 8 - 3);
}

}  // namespace kept_forces_test
}  // namespace pounding
