#include "common/gather_rows.h"

#include "common/parallel.h"

namespace pounding {

std::vector<double> gather_rows(MPI_Comm comm, const std::vector<double>& rows) {
  const auto ranks = static_cast<std::size_t>(size_of(comm));
  const int count = static_cast<int>(rows.size());
  std::vector<int> counts(ranks);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  std::vector<int> begins(ranks, 0);
  for (std::size_t r = 1; r < ranks; ++r) begins[r] = begins[r - 1] + counts[r - 1];
  std::vector<double> all(static_cast<std::size_t>(begins.back() + counts.back()));
  MPI_Allgatherv(rows.data(), count, MPI_DOUBLE, all.data(), counts.data(), begins.data(),
                 MPI_DOUBLE, comm);
  return all;
}

}  // namespace pounding
