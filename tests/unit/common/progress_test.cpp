#include "common/progress.h"

#include <chrono>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace pounding {
namespace progress_test {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// What a phase that sleeps for a time [s] prints, line by line.
std::vector<std::string> lines_of(double interval, double seconds, const std::string& how_far) {
  const std::unique_ptr<std::FILE, Close> file(std::tmpfile());
  {
    Progress progress(MPI_COMM_SELF, "a: modes", interval, file.get());
    if (!how_far.empty()) progress.at(how_far);
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  }
  std::rewind(file.get());
  std::vector<std::string> lines(1);
  for (int letter = std::fgetc(file.get()); letter != EOF; letter = std::fgetc(file.get())) {
    if (letter == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += static_cast<char>(letter);
    }
  }
  lines.pop_back();
  return lines;
}

TEST(Progress, IsSilentWhereAPhaseIsShort) {
  EXPECT_TRUE(lines_of(60, 0, "").empty());
  EXPECT_TRUE(lines_of(std::numeric_limits<double>::infinity(), 0.01, "").empty());
}

TEST(Progress, SaysWhatHowFarAndHowLong) {
  const std::vector<std::string> lines = lines_of(0.01, 0.1, "15 of 20");
  ASSERT_GE(lines.size(), 2u);
  EXPECT_LE(lines.size(), 6u);  // at 0.01, 0.02, 0.04, 0.08 s, and the end
  EXPECT_EQ(lines.front().find("  a: modes: 0.0 s, 15 of 20"), 0u) << lines.front();
  EXPECT_EQ(lines.front().find("done"), std::string::npos);
  EXPECT_EQ(lines.back(), "  a: modes: 0.1 s, 15 of 20, done");
}

TEST(Progress, NeedsNoWordFromThePhase) {
  const std::vector<std::string> lines = lines_of(0.02, 0.05, "");
  ASSERT_GE(lines.size(), 2u);
  EXPECT_EQ(lines.front().find("  a: modes: 0.0 s"), 0u) << lines.front();
}

}  // namespace progress_test
}  // namespace pounding
