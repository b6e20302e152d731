#include "common/floating_point.h"

#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace pounding {

void flush_subnormal_numbers() {
#ifdef __SSE2__
  constexpr unsigned flush_results = 0x8000;
  constexpr unsigned read_as_zero = 0x0040;
  _mm_setcsr(_mm_getcsr() | flush_results | read_as_zero);
#endif
}

}  // namespace pounding
