#include "observers/run_statistics.h"

#include "common/parallel.h"

namespace pounding {

PhaseReport report_phases(MPI_Comm comm, const Profile& profile, std::size_t dofs) {
  PhaseReport report;
  report.dofs = dofs;
  for (int number = 0; number < static_cast<int>(Phase::count); ++number) {
    const auto phase = static_cast<Phase>(number);
    const MemoryUse& memory = profile.memory(phase);
    double largest[2] = {profile.seconds(phase), memory.peak};
    double sums[2] = {memory.peak, memory.held};
    reduce_over_ranks(comm, MPI_MAX, largest);
    reduce_over_ranks(comm, MPI_SUM, sums);
    report.phases.push_back({largest[0], sums[0], largest[1], sums[1]});
  }
  report.peak = largest_memory();
  reduce_over_ranks(comm, MPI_SUM, report.peak);
  report.mesher = largest_memory_of_children();
  reduce_over_ranks(comm, MPI_MAX, report.mesher);
  return report;
}

}  // namespace pounding
