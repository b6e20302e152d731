#pragma once

namespace pounding {

/// Numbers below the normal range count as zero from now on, on this thread: a structure that comes
/// to rest would otherwise slow every operation down. Nothing where the processor has no such mode.
void flush_subnormal_numbers();

}  // namespace pounding
