#include "observers/run_statistics.h"

namespace pounding {

PhaseReport report_phases(MPI_Comm comm, const Profile& profile, std::size_t dofs) {
  PhaseReport report;
  report.dofs = dofs;
  for (int number = 0; number < static_cast<int>(Phase::count); ++number) {
    const auto phase = static_cast<Phase>(number);
    const MemoryUse& memory = profile.memory(phase);
    double largest[2] = {profile.seconds(phase), memory.peak};
    double sums[2] = {memory.peak, memory.held};
    MPI_Allreduce(MPI_IN_PLACE, largest, 2, MPI_DOUBLE, MPI_MAX, comm);
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, comm);
    report.phases.push_back({largest[0], sums[0], largest[1], sums[1]});
  }
  report.peak = largest_memory();
  MPI_Allreduce(MPI_IN_PLACE, &report.peak, 1, MPI_DOUBLE, MPI_SUM, comm);
  report.mesher = largest_memory_of_children();
  MPI_Allreduce(MPI_IN_PLACE, &report.mesher, 1, MPI_DOUBLE, MPI_MAX, comm);
  return report;
}

}  // namespace pounding
