#pragma once

#include <array>
#include <cfenv>
#include <cstddef>
#include <signal.h>

namespace pounding {

/// State of the process that a job changes: handlers of signals (PETSc has its own), the mode of
/// floating-point numbers, the vector unit. The destructor brings back those that the constructor
/// found. Local.
class ProcessState {
 public:
  ProcessState();
  ProcessState(const ProcessState&) = delete;
  ProcessState& operator=(const ProcessState&) = delete;
  ~ProcessState();

 private:
  static constexpr int last_signal = 31;  ///< those of real time behind it are nobody's here
  std::array<struct sigaction, last_signal + 1> handlers_{};
  std::fenv_t numbers_{};
  std::size_t unit_ = 0;
};

/// Numbers below the normal range count as zero from now on, on this thread: a structure that comes
/// to rest would otherwise slow every operation down. Nothing where the processor has no such mode.
void flush_subnormal_numbers();

}  // namespace pounding
