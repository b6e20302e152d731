#include "common/process_state.h"

#include "common/vector_unit.h"

#ifdef __SSE2__
#include <immintrin.h>
#endif

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

void flush_subnormal_numbers() {
#ifdef __SSE2__
  constexpr unsigned flush_results = 0x8000;
  constexpr unsigned read_as_zero = 0x0040;
  _mm_setcsr(_mm_getcsr() | flush_results | read_as_zero);
#endif
}

}  // namespace pounding
