#pragma once

#include <cstdint>

#include <mpi.h>

namespace pounding {

/// When to write a checkpoint, when to bring the records to the file and when to stop, the same on
/// every rank. The ranks agree by one small reduction about twenty times per second of wall time,
/// not in every step.
class CheckpointSchedule {
 public:
  /// `interval`: wall time between checkpoints [s]; `steps`: steps between them; 0: none.
  /// `first_step`: the next step of the run.
  CheckpointSchedule(MPI_Comm comm, double interval, std::int64_t steps, std::int64_t first_step);

  struct Decision {
    bool write = false;
    bool flush = false;  ///< the records, every ten seconds of wall time
    int signal = 0;      ///< that stops the run, which writes as well; 0: go on
  };
  /// After step `n`. Collective.
  Decision after_step(std::int64_t n);

 private:
  Decision agree(std::int64_t n);

  MPI_Comm comm_;
  double interval_;
  std::int64_t steps_;
  double last_write_;            ///< wall time [s]
  double last_flush_;            ///< wall time [s]
  double last_agreement_;        ///< wall time [s]
  std::int64_t agreement_step_;  ///< of the last agreement
  std::int64_t next_agreement_;
};

}  // namespace pounding
