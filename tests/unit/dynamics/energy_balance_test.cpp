#include "dynamics/energy_balance.h"

#include <gtest/gtest.h>

namespace pounding {
namespace {

/// The largest residual of the run over the largest term, both of any line.
TEST(EnergyBalance, RemembersTheLargestResidualAndTheLargestTerm) {
  const std::vector<LinearSystem> none;
  EnergyBalance balance(MPI_COMM_SELF, none, 1e-3);
  EnergyLine line;
  line.kinetic = 20;
  line.strain = 5;
  line.residual = -4;
  balance.note(line);
  EXPECT_DOUBLE_EQ(balance.relative_residual(), 4.0 / 20);
  line.contact_work = -50;
  line.residual = 1;
  balance.note(line);
  EXPECT_DOUBLE_EQ(balance.relative_residual(), 4.0 / 50);
  EXPECT_DOUBLE_EQ(balance.largest_term(), 50);
}

}  // namespace
}  // namespace pounding
