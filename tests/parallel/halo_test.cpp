#include "mesh/halo.h"

#include <gtest/gtest.h>
#include <petscsys.h>

#include "common/parallel.h"

namespace pounding {
namespace halo_test {

/// Rank r owns r + 1 dofs; each rank asks for the first dof of every other rank and the last one of
/// the rank before, in an order of its own.
void expect_ghosts_of_their_owners(bool common_memory) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const int rank = rank_of(comm);
  const int size = size_of(comm);
  const auto first = [](int r) { return static_cast<GlobalIndex>(r) * (r + 1) / 2; };
  std::vector<GlobalIndex> ghosts;
  if (rank > 1) ghosts.push_back(first(rank) - 1);
  for (int r = size - 1; r >= 0; --r) {
    if (r != rank) ghosts.push_back(first(r));
  }
  Halo halo(comm, first(rank), rank + 1, ghosts, common_memory);
  EXPECT_TRUE(common_memory || !halo.uses_common_memory());
  std::vector<double> owned(static_cast<std::size_t>(rank) + 1);
  for (int round = 1; round <= 1000; ++round) {
    for (std::size_t i = 0; i < owned.size(); ++i) {
      owned[i] = 1000.0 * round + static_cast<double>(first(rank)) + static_cast<double>(i);
    }
    halo.begin(owned.data());
    std::fill(owned.begin(), owned.end(), -1.0);  // the values have left
    halo.end();
    for (std::size_t i = 0; i < ghosts.size(); ++i) {
      ASSERT_EQ(halo.ghosts()[halo.slot(i)], 1000.0 * round + static_cast<double>(ghosts[i]));
    }
  }
  EXPECT_EQ(halo.neighbour_count(), size - 1);
}

TEST(Halo, GhostsTakeTheValuesOfTheirOwners) {
  expect_ghosts_of_their_owners(true);
}

TEST(Halo, GhostsTravelInMessagesToo) {
  expect_ghosts_of_their_owners(false);
}

TEST(Halo, RanksThatShareNothingStaySilent) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const int rank = rank_of(comm);
  std::vector<GlobalIndex> ghosts;
  if (rank == 1) ghosts.push_back(0);  // only ranks 0 and 1 meet; rank 2 owns nothing
  const LocalIndex count = rank < 2 ? 2 : 0;
  Halo halo(comm, rank < 2 ? 2 * rank : 4, count, ghosts);
  EXPECT_EQ(halo.neighbour_count(), size_of(comm) > 1 && rank < 2 ? 1 : 0);
  for (int round = 0; round < 1000; ++round) {
    const std::array<double, 2> owned{3.5 + rank + round, 4.5};
    halo.begin(owned.data());
    halo.end();
    if (rank == 1) {
      ASSERT_EQ(halo.ghosts()[halo.slot(0)], 3.5 + round);
    }
  }
}

}  // namespace halo_test
}  // namespace pounding
