#include "observers/run_progress.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace pounding {
namespace run_progress_test {

TEST(RunProgress, DurationsAreInWords) {
  EXPECT_EQ(duration_text(0), "0 s");
  EXPECT_EQ(duration_text(-1), "0 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(59.6), "1 min 00 s");
  EXPECT_EQ(duration_text(3599), "59 min 59 s");
  EXPECT_EQ(duration_text(7500), "2 h 05 min");
  EXPECT_EQ(duration_text(1e5), "27 h 46 min");
  EXPECT_EQ(duration_text(std::numeric_limits<double>::infinity()), "very long");
  EXPECT_EQ(duration_text(std::numeric_limits<double>::quiet_NaN()), "very long");
}

TEST(RunProgress, LineNamesItsNumbers) {
  // 10 s of wall time for 2 s: 5 per second, 15 s to go.
  RunPosition position{7, 10, 2, 10, 1.5e-3, 3, 2e-15};
  EXPECT_EQ(progress_line(position),
            "  70.0 %: t = 7 of 10 s, 5 s of wall time per simulated s, 15 s left, smallest gap "
            "1.50 mm, 3 impacts, energy residual 2.0e-15");
  position.smallest_gap = std::numeric_limits<double>::max();
  EXPECT_EQ(progress_line(position),
            "  70.0 %: t = 7 of 10 s, 5 s of wall time per simulated s, 15 s left, energy residual "
            "2.0e-15");
}

/// What is printed at these wall times [s].
std::string shown(bool watched, double interval, std::initializer_list<double> times) {
  testing::internal::CaptureStdout();
  RunProgress progress(watched, interval);
  for (const double time : times) {
    progress.show({time, 1000, time, time, std::numeric_limits<double>::max(), 0, 0});
  }
  return testing::internal::GetCapturedStdout();
}

std::ptrdiff_t count(const std::string& text, char letter) {
  return std::count(text.begin(), text.end(), letter);
}

TEST(RunProgress, FilesGetLinesThatGrowRarer) {
  EXPECT_EQ(shown(false, 2, {0.1, 1.9}), "");
  EXPECT_EQ(count(shown(false, 2, {1, 2, 3, 4, 5, 6, 7, 8, 15, 16}), '\n'), 4);  // 2, 4, 8, 16
  EXPECT_EQ(count(shown(false, 2, {500, 501, 559, 561}), '\n'), 2);  // at most a minute apart
  EXPECT_EQ(count(shown(false, 2, {2, 100}), '\r'), 0);
}

TEST(RunProgress, TerminalsGetOneLine) {
  const std::string text = shown(true, 2, {1, 2});
  EXPECT_EQ(count(text, '\r'), 2);
  EXPECT_EQ(count(text, '\n'), 0);
  EXPECT_EQ(text.size(), 2u * 80);  // no terminal: 80 columns, of which the last stays free
}

}  // namespace run_progress_test
}  // namespace pounding
