#include "common/process_state.h"

#include "common/vector_unit.h"

namespace pounding {

ProcessState::ProcessState() : unit_(unit_number()) {
  for (int signal = 1; signal <= last_signal; ++signal) {
    sigaction(signal, nullptr, &handlers_[signal]);
  }
  std::fegetenv(&numbers_);
}

ProcessState::~ProcessState() {
  for (int signal = 1; signal <= last_signal; ++signal) {
    if (signal != SIGKILL && signal != SIGSTOP) sigaction(signal, &handlers_[signal], nullptr);
  }
  std::fesetenv(&numbers_);
  use_unit_number(unit_);
}

}  // namespace pounding
