#pragma once

namespace pounding {

/// Resident memory of a process [bytes]; shared memory counts on each of its ranks.
struct MemoryUse {
  double held = 0;  ///< now
  double peak = 0;  ///< largest since the last time that somebody asked
};

/// Memory of this process; begins a new peak where the system lets it, else `peak` is that since
/// the process began.
MemoryUse take_memory_use();

/// Largest resident memory of this process so far [bytes], whoever asked before.
double largest_memory();

/// Largest resident memory of a process that this one started and that ended [bytes].
double largest_memory_of_children();

}  // namespace pounding
