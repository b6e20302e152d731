#include "driver/run_progress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "driver/terminal.h"

namespace pounding {
namespace {

constexpr double longest_silence = 60;  // s

template <typename... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

}  // namespace

std::string duration_text(double seconds) {
  if (!(seconds < 1e9)) return "very long";
  const auto whole = static_cast<long long>(std::round(std::max(seconds, 0.0)));
  if (whole < 60) return formatted("%lld s", whole);
  if (whole < 3600) return formatted("%lld min %02lld s", whole / 60, whole % 60);
  return formatted("%lld h %02lld min", whole / 3600, whole % 3600 / 60);
}

std::string progress_line(const RunPosition& position) {
  const double cost = position.elapsed / std::max(position.simulated, 1e-300);
  std::string line =
      formatted("  %.1f %%: t = %.4g of %.4g s, %.3g s of wall time per simulated s, ",
                100 * position.time / position.end_time, position.time, position.end_time, cost);
  line += duration_text(cost * (position.end_time - position.time)) + " left";
  if (position.smallest_gap < std::numeric_limits<double>::max()) {
    line += formatted(", smallest gap %.2f mm, %lld impacts", 1000 * position.smallest_gap,
                      position.impacts);
  }
  return line + formatted(", energy residual %.1e", position.energy_residual);
}

void RunProgress::show(const RunPosition& position) {
  if (!watched_ && position.elapsed < next_) return;
  while (next_ <= position.elapsed) next_ += std::min(next_, std::max(interval_, longest_silence));
  const std::string line = progress_line(position);
  if (watched_) {
    std::printf("\r%-*s", terminal_width() - 1, line.substr(0, terminal_width() - 1).c_str());
  } else {
    std::printf("%s\n", line.c_str());
  }
  std::fflush(stdout);
}

}  // namespace pounding
