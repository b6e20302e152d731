#include <gtest/gtest.h>
#include <slepcsys.h>

#include "common/crowded_node.h"

/// Every rank runs every test; the job fails if any rank does.
int main(int count, char** words) {
  testing::InitGoogleTest(&count, words);
  pounding::yield_while_waiting();
  pounding::listen_nowhere();
  SlepcInitialize(&count, &words, nullptr, nullptr);
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  if (rank != 0) {
    delete testing::UnitTest::GetInstance()->listeners().Release(
        testing::UnitTest::GetInstance()->listeners().default_result_printer());
  }
  int status = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &status, 1, MPI_INT, MPI_MAX, PETSC_COMM_WORLD);
  SlepcFinalize();
  return status;
}
