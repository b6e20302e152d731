#include "driver/phase_report.h"

#include <algorithm>
#include <cstdio>

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

void print_phases(const PhaseReport& report) {
  constexpr double megabyte = 1e6;
  std::printf("  %-12s %10s %14s %14s %14s %10s\n", "phase", "time [s]", "memory [MB]",
              "at its end", "largest rank", "[B/dof]");
  for (std::size_t number = 0; number < report.phases.size(); ++number) {
    const PhaseUse& use = report.phases[number];
    std::printf("  %-12s %10.3f", phase_name(static_cast<Phase>(number)), use.seconds);
    if (use.peak > 0) {
      std::printf(" %14.0f %14.0f %14.0f %10.0f", use.peak / megabyte, use.held / megabyte,
                  use.largest_rank / megabyte,
                  use.peak / static_cast<double>(std::max<std::size_t>(1, report.dofs)));
    }
    std::printf("\n");
  }
  if (report.mesher > 0) {
    std::printf("  Gmsh's process held %.0f MB at most\n", report.mesher / megabyte);
  }
}

}  // namespace pounding
