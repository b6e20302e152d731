#include "common/shared_exchange.h"

#include <array>
#include <ctime>
#include <sched.h>
#include <thread>

#include <gtest/gtest.h>
#include <petscsys.h>

#include "common/parallel.h"

namespace pounding {
namespace shared_exchange_test {

/// Keeps this process on one processor, the same on all ranks, while it lives. Collective.
class OneProcessor {
 public:
  explicit OneProcessor(MPI_Comm comm) {
    sched_getaffinity(0, sizeof before_, &before_);
    int processor = 0;
    while (CPU_ISSET(processor, &before_) == 0) ++processor;
    MPI_Bcast(&processor, 1, MPI_INT, 0, comm);
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(processor, &one);
    kept_ = sched_setaffinity(0, sizeof one, &one) == 0;
  }
  OneProcessor(const OneProcessor&) = delete;
  OneProcessor& operator=(const OneProcessor&) = delete;
  ~OneProcessor() { sched_setaffinity(0, sizeof before_, &before_); }

  bool kept() const { return kept_; }

 private:
  cpu_set_t before_{};
  bool kept_ = false;
};

/// Of this process [s]: what others do meanwhile is not in it.
double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Every turn needs every rank, and only one of them runs at a time. A rank that held on to the
/// processor while it waits would use up its share of some milliseconds in each turn.
TEST(SharedExchange, RanksThatShareAProcessorGiveItToEachOther) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const int ranks = size_of(comm);
  SharedExchange exchange(comm, 1);
  const OneProcessor pinned(comm);
  int able = exchange.works() && pinned.kept() ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &able, 1, MPI_INT, MPI_MIN, comm);
  if (able == 0) GTEST_SKIP() << "no common memory, or processors cannot be chosen";
  constexpr int turns = 1000;
  // s per turn and rank. Beyond the processors there are, ranks do not look long before they give
  // way: 4e-6 to 7e-6 are used; else they look for 1e-4.
  const bool crowded = static_cast<unsigned>(ranks) > std::thread::hardware_concurrency();
  const double bearable = crowded ? 5e-5 : 1e-3;
  int wrong = 0;
  const double start = processor_time();
  for (int turn = 0; turn < turns; ++turn) {
    exchange.publish(std::array{1000.0 * rank_of(comm) + turn});
    for (int rank = 0; rank < ranks; ++rank) {
      wrong += exchange.wait_for(rank)[0] != 1000.0 * rank + turn;
    }
  }
  EXPECT_LT((processor_time() - start) / turns, bearable);
  EXPECT_EQ(wrong, 0);
}

}  // namespace shared_exchange_test
}  // namespace pounding
