#include "common/crowded_node.h"

#include <array>
#include <cstdlib>
#include <optional>
#include <sched.h>
#include <string>

#include <gtest/gtest.h>

namespace pounding {
namespace {

constexpr std::array variables{"OMPI_COMM_WORLD_LOCAL_SIZE", "OMPI_MCA_orte_bound_at_launch",
                               "OMPI_MCA_mpi_yield_when_idle"};

/// On the first processor of this process, with none of the variables; all back at the end.
class CrowdedNode : public testing::Test {
 protected:
  CrowdedNode() {
    for (std::size_t i = 0; i < variables.size(); ++i) {
      if (const char* const value = std::getenv(variables[i])) before_[i] = value;
      unsetenv(variables[i]);
    }
    sched_getaffinity(0, sizeof processors_, &processors_);
    int first = 0;
    while (CPU_ISSET(first, &processors_) == 0) ++first;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(first, &one);
    sched_setaffinity(0, sizeof one, &one);
  }
  ~CrowdedNode() override {
    sched_setaffinity(0, sizeof processors_, &processors_);
    for (std::size_t i = 0; i < variables.size(); ++i) {
      unsetenv(variables[i]);
      if (before_[i]) setenv(variables[i], before_[i]->c_str(), 1);
    }
  }

  static void set(const char* variable, const std::string& value) {
    setenv(variable, value.c_str(), 1);
  }
  static std::string chosen() {
    yield_where_crowded();
    const char* const value = std::getenv("OMPI_MCA_mpi_yield_when_idle");
    return value != nullptr ? value : "";
  }

 private:
  cpu_set_t processors_{};
  std::array<std::optional<std::string>, variables.size()> before_;
};

TEST_F(CrowdedNode, IsNoneUnderAnUnknownLauncher) {
  EXPECT_FALSE(crowded_node());
  EXPECT_EQ(chosen(), "");
}

TEST_F(CrowdedNode, IsNoneWhereEveryRankHasAProcessor) {
  set("OMPI_COMM_WORLD_LOCAL_SIZE", "1");
  EXPECT_FALSE(crowded_node());
  EXPECT_EQ(chosen(), "");
}

TEST_F(CrowdedNode, IsOneWithMoreRanksThanProcessors) {
  set("OMPI_COMM_WORLD_LOCAL_SIZE", "2");
  EXPECT_TRUE(crowded_node());
  EXPECT_EQ(chosen(), "1");
}

/// A rank that is bound sees its own processors only: it tells by those of the node.
TEST_F(CrowdedNode, CountsAllProcessorsWhereRanksAreBound) {
  set("OMPI_MCA_orte_bound_at_launch", "1");
  set("OMPI_COMM_WORLD_LOCAL_SIZE", "1000000");
  EXPECT_TRUE(crowded_node());
  set("OMPI_COMM_WORLD_LOCAL_SIZE", "1");
  EXPECT_FALSE(crowded_node());
}

TEST_F(CrowdedNode, LeavesTheUserTheChoice) {
  set("OMPI_COMM_WORLD_LOCAL_SIZE", "2");
  set("OMPI_MCA_mpi_yield_when_idle", "0");
  EXPECT_EQ(chosen(), "0");
}

}  // namespace
}  // namespace pounding
