#include "common/memory.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace pounding {

#ifdef __GLIBC__

void return_large_arrays() {
  constexpr int large = 1 << 18;      // [B]; setting it keeps it from growing
  constexpr int most_arrays = 65536;  // the C library's own default, which MPI may have set to 0
  mallopt(M_MMAP_THRESHOLD, large);
  mallopt(M_MMAP_MAX, most_arrays);
}

void return_freed_memory() {
  malloc_trim(0);
}

#else

void return_large_arrays() {}
void return_freed_memory() {}

#endif

}  // namespace pounding
