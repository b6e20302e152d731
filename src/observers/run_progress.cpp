#include "observers/run_progress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <sys/ioctl.h>
#include <unistd.h>

#include "common/crowded_node.h"
#include "common/facts.h"
#include "common/parallel.h"
#include "common/progress.h"
#include "observers/impact_catalogue.h"
#include "observers/observed_run.h"

namespace pounding {
namespace {

/// Where the standard output of a process goes; "" where that is not to be seen.
std::string standard_output(const std::string& process) {
  std::error_code failure;
  return std::filesystem::read_symlink("/proc/" + process + "/fd/1", failure);
}

class ProgressWatch final : public Observer {
 public:
  ProgressWatch(const ObservedRun& run, Observers& before)
      : run_(run),
        impacts_(before.impacts()),
        progress_(is_watched(), run.scene.progress_interval),
        stride_(std::max<std::int64_t>(1, run.model.steps / 200)) {}

  void start(const CdLagrange& stepper, const SavedState* continued) override {
    begun_at_ = continued != nullptr ? stepper.time() : 0;
    wall_start_ = MPI_Wtime();
  }

  std::int64_t next_due(std::int64_t step) const override {
    return next_multiple(std::max<std::int64_t>(step, 1), stride_);
  }

  void observe(const CdLagrange& stepper) override {
    const double no_gap = std::numeric_limits<double>::max();
    std::array<double, 2> now{no_gap, 0};  // smallest gap, minus the number of impacts
    if (run_.is_contact_member()) {
      now = {run_.scheme.contact()->smallest_gap(), -static_cast<double>(impacts_.episodes())};
    }
    reduce_over_ranks(run_.comm, MPI_MIN, now);
    if (rank_of(run_.comm) != 0) return;
    progress_.show({stepper.time(), run_.scene.end_time, stepper.time() - begun_at_,
                    MPI_Wtime() - wall_start_, now[0], std::llround(-now[1]),
                    stepper.energy().relative_residual()});
  }

 private:
  ObservedRun run_;
  const ImpactCatalogue& impacts_;
  RunProgress progress_;
  std::int64_t stride_;    ///< steps between two looks
  double begun_at_ = 0;    ///< simulated time at the start [s]
  double wall_start_ = 0;  ///< [s]
};

}  // namespace

std::string duration_text(double seconds) {
  if (!(seconds < 1e9)) return "very long";
  const auto whole = static_cast<long long>(std::round(std::max(seconds, 0.0)));
  if (whole < 60) return sentence("{} s", {whole});
  if (whole < 3600) return sentence("{} min {:02d} s", {whole / 60, whole % 60});
  return sentence("{} h {:02d} min", {whole / 3600, whole % 3600 / 60});
}

std::string progress_line(const RunPosition& position) {
  const double cost = position.elapsed / std::max(position.simulated, 1e-300);
  std::string line =
      sentence("  {:.1f} %: t = {:.4g} of {:.4g} s, {:.3g} s of wall time per simulated s, {} left",
               {100 * position.time / position.end_time, position.time, position.end_time, cost,
                duration_text(cost * (position.end_time - position.time))});
  if (position.smallest_gap < std::numeric_limits<double>::max()) {
    line += sentence(", smallest gap {:.2f} mm, {} impacts",
                     {1000 * position.smallest_gap, position.impacts});
  }
  return line + sentence(", energy residual {:.1e}", {position.energy_residual});
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

OutputKind progress_output() {
  return output<ProgressWatch>({});
}

bool is_watched() {
  if (isatty(STDOUT_FILENO) == 0) return false;
  if (std::getenv("OMPI_COMM_WORLD_RANK") == nullptr && std::getenv("PMI_RANK") == nullptr) {
    return true;
  }
  // Scripts between mpirun and the program have the same terminal as the program.
  const std::string own = standard_output("self");
  pid_t process = getppid();
  while (process > 0 && standard_output(std::to_string(process)) == own) {
    process = parent_of(process);
  }
  const std::string outer = standard_output(std::to_string(process));
  return outer.empty() || outer.starts_with("/dev/pts/") || outer.starts_with("/dev/tty") ||
         outer == "/dev/console";
}

int terminal_width() {
  constexpr int usual = 80;
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0) return usual;
  return size.ws_col > 1 ? size.ws_col : usual;
}

}  // namespace pounding
