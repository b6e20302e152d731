#include "common/crowded_node.h"

#include <cstdlib>
#include <sched.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace pounding {
namespace crowded_node_test {

constexpr const char* yields = "OMPI_MCA_mpi_yield_when_idle";

cpu_set_t first_of(const cpu_set_t& processors) {
  int first = 0;
  while (CPU_ISSET(first, &processors) == 0) ++first;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  return one;
}

/// This process is the launcher, on its first processor; ranks are processes that it starts.
class CrowdedNode : public testing::Test {
 protected:
  CrowdedNode() {
    sched_getaffinity(0, sizeof processors_, &processors_);
    run_on(first_of(processors_));
  }
  ~CrowdedNode() override { run_on(processors_); }

  static void run_on(const cpu_set_t& processors) {
    sched_setaffinity(0, sizeof processors, &processors);
  }
  const cpu_set_t& all_processors() const { return processors_; }

  struct Seen {
    bool crowded;
    std::string choice;  ///< of the variable with which Open MPI yields, "" for none
  };

  /// What a rank on the processors `bound` sees where it is one of `ranks`, "" for another launcher's; one
  /// more rank is on another node, unless all are on this one.
  static Seen seen_by_a_rank(const std::string& ranks, const cpu_set_t& bound,
                             const std::string& choice = "", bool on_one_node = false) {
    const pid_t rank = fork();
    if (rank == 0) {
      run_on(bound);
      unsetenv("OMPI_COMM_WORLD_LOCAL_SIZE");
      unsetenv(yields);
      if (!ranks.empty()) {
        const int all = std::stoi(ranks) + (on_one_node ? 0 : 1);
        setenv("OMPI_COMM_WORLD_LOCAL_SIZE", ranks.c_str(), 1);
        setenv("OMPI_COMM_WORLD_SIZE", std::to_string(all).c_str(), 1);
      }
      if (!choice.empty()) setenv(yields, choice.c_str(), 1);
      const bool crowded = crowded_node();
      yield_while_waiting();
      const char* const value = std::getenv(yields);
      _exit((crowded ? 1 : 0) + (value != nullptr ? 2 * (1 + std::atoi(value)) : 0));
    }
    int status = 0;
    waitpid(rank, &status, 0);
    EXPECT_TRUE(WIFEXITED(status));
    const int told = WEXITSTATUS(status);
    return {(told & 1) != 0, told / 2 > 0 ? std::to_string(told / 2 - 1) : ""};
  }

 private:
  cpu_set_t processors_{};
};

TEST_F(CrowdedNode, IsNoneUnderAnUnknownLauncher) {
  const Seen seen = seen_by_a_rank("", first_of(all_processors()));
  EXPECT_FALSE(seen.crowded);
  EXPECT_EQ(seen.choice, "");
}

TEST_F(CrowdedNode, RanksOfOneNodeYieldWhereverTheyAre) {
  const Seen seen = seen_by_a_rank("1", first_of(all_processors()), "", true);
  EXPECT_FALSE(seen.crowded);
  EXPECT_EQ(seen.choice, "1");
}

TEST_F(CrowdedNode, IsNoneWhereEveryRankHasAProcessor) {
  const Seen seen = seen_by_a_rank("1", first_of(all_processors()));
  EXPECT_FALSE(seen.crowded);
  EXPECT_EQ(seen.choice, "");
}

TEST_F(CrowdedNode, IsOneWithMoreRanksThanProcessors) {
  const Seen seen = seen_by_a_rank("2", first_of(all_processors()));
  EXPECT_TRUE(seen.crowded);
  EXPECT_EQ(seen.choice, "1");
}

/// A rank that is bound sees its own processors only: it tells by those of the launcher.
TEST_F(CrowdedNode, CountsTheLaunchersProcessorsWhereRanksAreBound) {
  run_on(all_processors());
  const int count = CPU_COUNT(&all_processors());
  EXPECT_FALSE(seen_by_a_rank(std::to_string(count), first_of(all_processors())).crowded);
  EXPECT_TRUE(seen_by_a_rank(std::to_string(count + 1), all_processors()).crowded);
}

TEST_F(CrowdedNode, LeavesTheUserTheChoice) {
  EXPECT_EQ(seen_by_a_rank("2", first_of(all_processors()), "0").choice, "0");
}

}  // namespace crowded_node_test
}  // namespace pounding
