#include "common/progress.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <system_error>
#include <utility>

#include "common/memory.h"
#include "common/parallel.h"

namespace pounding {
namespace {

double now() {
  using std::chrono::steady_clock;
  return std::chrono::duration<double>(steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Progress::Progress(MPI_Comm comm, std::string what, double interval, std::FILE* out)
    : what_(std::move(what)), out_(out), interval_(interval), start_(now()) {
  if (std::isfinite(interval) && rank_of(comm) == 0) {
    share_memory_among_threads();
    try {
      watcher_ = std::thread([this, interval] { watch(interval); });
    } catch (const std::system_error&) {
      // No memory for a thread: the work goes on untold, until it lacks memory itself.
    }
  }
}

Progress::~Progress() {
  if (!watcher_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  ended_.notify_one();
  watcher_.join();
  if (printed_ || elapsed() >= interval_) print(", done");
}

void Progress::at(std::string how_far) {
  if (!watcher_.joinable()) return;
  const std::lock_guard lock(mutex_);
  how_far_ = std::move(how_far);
}

void Progress::watch(double interval) {
  std::unique_lock lock(mutex_);
  const auto over = [this] { return over_; };
  double next = interval;
  constexpr double longest_wait = 1e6;  // s; clocks count nanoseconds
  const auto wait = [&] {
    return std::chrono::duration<double>(std::min(next - elapsed(), longest_wait));
  };
  while (!ended_.wait_for(lock, wait(), over)) {
    if (elapsed() < next) continue;
    print("");
    next += std::min(next, std::max(interval, longest_silence));
  }
}

void Progress::print(const std::string& end) {
  printed_ = true;
  std::fprintf(out_, "  %s: %.1f s%s%s%s\n", what_.c_str(), elapsed(), how_far_.empty() ? "" : ", ",
               how_far_.c_str(), end.c_str());
  std::fflush(out_);
}

double Progress::elapsed() const {
  return now() - start_;
}

}  // namespace pounding
