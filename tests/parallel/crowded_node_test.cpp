#include "common/crowded_node.h"

#include <cstdlib>
#include <thread>

#include <gtest/gtest.h>
#include <mpi.h>

#include "common/parallel.h"

namespace pounding {
namespace crowded_node_test {

/// What Open MPI does while it waits, by its own word.
bool yields_when_idle() {
  int given = 0;
  MPI_T_init_thread(MPI_THREAD_SINGLE, &given);
  int index = 0;
  int count = 0;
  bool value = false;  // as Open MPI keeps it
  MPI_T_cvar_handle handle = nullptr;
  EXPECT_EQ(MPI_T_cvar_get_index("mpi_yield_when_idle", &index), MPI_SUCCESS);
  EXPECT_EQ(MPI_T_cvar_handle_alloc(index, nullptr, &handle, &count), MPI_SUCCESS);
  EXPECT_EQ(MPI_T_cvar_read(handle, &value), MPI_SUCCESS);
  MPI_T_cvar_handle_free(&handle);
  MPI_T_finalize();
  return value;
}

TEST(CrowdedNode, IsOneWithMoreRanksThanProcessors) {
  const bool one = std::getenv("POUNDING_ONE_PROCESSOR") != nullptr;
  const unsigned processors = one ? 1 : std::thread::hardware_concurrency();
  const bool crowded = static_cast<unsigned>(size_of(MPI_COMM_WORLD)) > processors;
  EXPECT_EQ(crowded_node(), crowded);
  EXPECT_EQ(yields_when_idle(), crowded);
}

}  // namespace crowded_node_test
}  // namespace pounding
