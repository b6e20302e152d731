#include <gtest/gtest.h>
#include <petscsys.h>

#include "common/parallel.h"
#include "interactions/interface_rows.h"

namespace pounding {
namespace interface_gather_test {

constexpr int dofs = 37;

/// Interface dofs dealt out in turns; the last of three or more ranks knows none.
std::vector<int> dofs_of(int rank, int size) {
  const int members = size > 2 ? size - 1 : size;
  std::vector<int> mine;
  for (int dof = dofs - 1; dof >= 0; --dof) {
    if (dof % members == rank) mine.push_back(dof);
  }
  return mine;
}

double value(int turn, int field, int dof) {
  return 1e6 * turn + 1000.0 * field + dof;
}

/// The values of a turn as a member gets them, shape (fields, dofs); -1 where none comes.
std::vector<double> gathered(interactions::InterfaceGather& gather, const std::vector<int>& mine,
                             int turn, int fields) {
  std::vector<double> known;
  for (const int dof : mine) {
    for (int field = 0; field < fields; ++field) known.push_back(value(turn, field, dof));
  }
  std::vector<double> all(static_cast<std::size_t>(fields * dofs), -1.0);
  gather.gather(fields, known, all);
  return all;
}

class InterfaceGathered : public testing::TestWithParam<bool> {};

/// So many turns that a rank that runs ahead would be seen to overwrite what another still reads.
TEST_P(InterfaceGathered, EveryMemberGetsAllValuesInEveryTurn) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const std::vector<int> mine = dofs_of(rank_of(comm), size_of(comm));
  interactions::InterfaceGather gather(comm, mine, GetParam());
  EXPECT_EQ(gather.member(), !mine.empty());
  EXPECT_EQ(gather.root(), 0);
  EXPECT_EQ(gather.members(), size_of(comm) > 2 ? size_of(comm) - 1 : size_of(comm));
  if (!gather.member()) return;
  int wrong = 0;
  for (int turn = 0; turn < 3000; ++turn) {
    const int fields = 1 + turn % interactions::InterfaceGather::max_fields;
    const std::vector<double> all = gathered(gather, mine, turn, fields);
    for (int field = 0; field < fields; ++field) {
      for (int dof = 0; dof < dofs; ++dof) {
        wrong += all[static_cast<std::size_t>(field * dofs + dof)] != value(turn, field, dof);
      }
    }
    if (turn % 7 == 0) {
      std::vector<double> sums(turn % 2 == 0 ? 5 : 100, rank_of(comm) + 1.0);
      gather.reduce(MPI_SUM, sums);
      const int members = gather.members();
      for (const double sum : sums) wrong += sum != members * (members + 1) / 2;
    }
  }
  EXPECT_EQ(wrong, 0);
}

/// A rank takes the values that it wants and its own, and no others, also where some want nothing.
TEST_P(InterfaceGathered, MembersTakeWhatTheyWant) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const std::vector<int> mine = dofs_of(rank_of(comm), size_of(comm));
  interactions::InterfaceGather gather(comm, mine, GetParam());
  if (!gather.member()) return;
  std::vector<int> wanted;  // of the last member nothing
  for (int dof = rank_of(comm); rank_of(comm) + 1 < gather.members() && dof < dofs; dof += 3) {
    wanted.push_back(dof);
  }
  gather.want(wanted);
  EXPECT_EQ(gather.exchanges(), gather.members() > 1);
  std::vector<char> comes(dofs, 0);
  for (const int dof : mine) comes[dof] = 1;
  for (const int dof : wanted) comes[dof] = 1;
  int wrong = 0;
  for (int turn = 0; turn < 3000; ++turn) {
    const int fields = 1 + turn % interactions::InterfaceGather::max_fields;
    const std::vector<double> all = gathered(gather, mine, turn, fields);
    for (int i = 0; i < fields * dofs; ++i) {
      const int dof = i % dofs;
      wrong += all[i] != (comes[dof] != 0 ? value(turn, i / dofs, dof) : -1.0);
    }
    std::vector<double> least{static_cast<double>(turn - rank_of(comm))};
    if (turn % 5 == 0) {
      gather.reduce(MPI_MIN, least);
      wrong += least[0] != turn + 1 - gather.members();
    }
  }
  EXPECT_EQ(wrong, 0);
  gather.want({});
  EXPECT_FALSE(gather.exchanges());
}

INSTANTIATE_TEST_SUITE_P(Ways, InterfaceGathered, testing::Values(true, false),
                         [](const auto& info) { return info.param ? "memory" : "messages"; });

}  // namespace interface_gather_test
}  // namespace pounding
