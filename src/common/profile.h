#pragma once

#include <algorithm>
#include <array>

#include <mpi.h>

#include "common/memory.h"

/// Wall time and memory by phase. `step`: stiffness product and update of the state, fused.
namespace pounding {

enum class Phase { mesh, partition, assembly, modes, step, contact, energy, output, count };

const char* phase_name(Phase phase);

/// Accumulated wall time [s] and memory [bytes] of this rank.
class Profile {
 public:
  enum class Clock { on, off };
  /// `clock`: off where steps are too short to be timed one by one; no time is charged then.
  explicit Profile(Clock clock = Clock::on) : clock_(clock) {}
  double now() const { return clock_ == Clock::on ? MPI_Wtime() : 0; }  ///< [s]
  void add(Phase phase, double seconds) { seconds_[static_cast<std::size_t>(phase)] += seconds; }
  double seconds(Phase phase) const { return seconds_[static_cast<std::size_t>(phase)]; }
  /// Charges to a phase the memory held since the phase noted before; opens files.
  void note_memory(Phase phase) {
    const MemoryUse use = take_memory_use();
    MemoryUse& noted = memory_[static_cast<std::size_t>(phase)];
    noted = {use.held, std::max(noted.peak, use.peak)};
  }
  /// Memory of a phase, the largest and that at its end; zeros if it was not noted.
  const MemoryUse& memory(Phase phase) const { return memory_[static_cast<std::size_t>(phase)]; }

 private:
  Clock clock_;
  std::array<double, static_cast<std::size_t>(Phase::count)> seconds_{};
  std::array<MemoryUse, static_cast<std::size_t>(Phase::count)> memory_{};
};

/// Charges its lifetime to a phase, and the memory to one of the start-up.
class ScopedTimer {
 public:
  ScopedTimer(Profile& profile, Phase phase)
      : profile_(profile), phase_(phase), start_(profile.now()) {}
  ScopedTimer(const ScopedTimer&) = delete;
  ScopedTimer& operator=(const ScopedTimer&) = delete;
  ~ScopedTimer() {
    profile_.add(phase_, profile_.now() - start_);
    if (phase_ < Phase::step) profile_.note_memory(phase_);
  }

 private:
  Profile& profile_;
  Phase phase_;
  double start_;
};

}  // namespace pounding
