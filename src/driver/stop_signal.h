#pragma once

#include <array>
#include <signal.h>
#include <string>

namespace pounding {

/// While this object lives, SIGTERM, SIGINT, SIGHUP and SIGUSR1 are kept for the run to look at
/// instead of ending the program; SIGHUP only if the program does not ignore it. One at a time.
class StopSignal {
 public:
  StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;
  ~StopSignal();

  /// The signal that this rank received, 0: none.
  static int received();

 private:
  static constexpr std::array signals{SIGTERM, SIGINT, SIGHUP, SIGUSR1};
  std::array<struct sigaction, signals.size()> before_{};
};

/// "SIGTERM".
std::string signal_name(int signal);

}  // namespace pounding
