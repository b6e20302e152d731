#pragma once

#include <array>

#include <mpi.h>

/// Wall time by phase. `step`: stiffness product and update of velocity and displacement, fused.
namespace pounding {

enum class Phase { mesh, partition, assembly, modes, step, contact, energy, output, count };

const char* phase_name(Phase phase);

/// Accumulated wall time of this rank [s].
class Profile {
 public:
  void add(Phase phase, double seconds) { seconds_[static_cast<std::size_t>(phase)] += seconds; }
  double seconds(Phase phase) const { return seconds_[static_cast<std::size_t>(phase)]; }

 private:
  std::array<double, static_cast<std::size_t>(Phase::count)> seconds_{};
};

/// Charges its lifetime to a phase.
class ScopedTimer {
 public:
  ScopedTimer(Profile& profile, Phase phase)
      : profile_(profile), phase_(phase), start_(MPI_Wtime()) {}
  ScopedTimer(const ScopedTimer&) = delete;
  ScopedTimer& operator=(const ScopedTimer&) = delete;
  ~ScopedTimer() { profile_.add(phase_, MPI_Wtime() - start_); }

 private:
  Profile& profile_;
  Phase phase_;
  double start_;
};

}  // namespace pounding
