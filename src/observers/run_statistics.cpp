#include "observers/run_statistics.h"

#include <algorithm>
#include <cmath>

namespace pounding {

interactions::LinkTotals LoopReport::whole() const {
  interactions::LinkTotals most;
  for (const interactions::LinkTotals& link : totals) {
    most.largest_elongation = std::max(most.largest_elongation, link.largest_elongation);
    most.largest_force = std::max(most.largest_force, link.largest_force);
    most.work += link.work;
    most.yielded += link.yielded;
  }
  return most;
}

std::size_t ForceReport::largest(std::size_t component) const {
  std::size_t best = 0;
  const auto size = [&](std::size_t e) {
    return std::abs(peaks[e * components.size() + component].value);
  };
  for (std::size_t e = 1; e < elements.size(); ++e) best = size(e) > size(best) ? e : best;
  return best;
}

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
