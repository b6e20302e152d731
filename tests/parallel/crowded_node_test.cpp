#include "common/crowded_node.h"

#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <mpi.h>

#include "common/parallel.h"
#include "common/shared_exchange.h"

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
  EXPECT_TRUE(yields_when_idle());  // all ranks of a test are on one node
}

/// Threads that want a processor of their own for as long as this object lives.
class Burners {
 public:
  explicit Burners(unsigned count) {
    for (unsigned i = 0; i < count; ++i) {
      threads_.emplace_back([this] {
        while (!done_.load(std::memory_order_relaxed)) {
        }
      });
    }
  }
  Burners(const Burners&) = delete;
  Burners& operator=(const Burners&) = delete;
  ~Burners() {
    done_ = true;
    for (std::thread& thread : threads_) thread.join();
  }

 private:
  std::atomic<bool> done_{false};
  std::vector<std::thread> threads_;
};

TEST(NodeLoad, IsAboveProcessorsBesideOneMoreThreadThanThereAre) {
  const Burners burners(std::thread::hardware_concurrency() + 1);
  bool above = false;
  for (int look = 0; look < 500 && !above; ++look) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    above = NodeLoad().is_above_processors();
  }
  EXPECT_TRUE(above);
}

/// Processor time of this thread [s].
double thread_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

TEST(NodeLoad, OfOthersHasARankSleepWhileItWaits) {
  const MPI_Comm comm = MPI_COMM_WORLD;
  SharedExchange exchange(comm, 1);
  if (size_of(comm) == 1 || !exchange.works()) GTEST_SKIP() << "nobody to wait for";
  const Burners burners(std::thread::hardware_concurrency() + 1);
  MPI_Barrier(comm);
  const bool late = rank_of(comm) == 0;
  if (late) std::this_thread::sleep_for(std::chrono::seconds(1));
  const double start = thread_time();
  exchange.publish(std::array{1.0});
  for (int rank = 0; rank < size_of(comm); ++rank) exchange.wait_for(rank);
  if (!late) {
    EXPECT_LT(thread_time() - start, 0.2);  // it waited for about a second: measured 0.01
  }
}

}  // namespace crowded_node_test
}  // namespace pounding
