#include "output/saved_state_exchange.h"

#include <numeric>

#include "common/parallel.h"

namespace pounding {
SavedTables collect_tables(MPI_Comm comm, const SavedTables& tables) {
  SavedTables all;
  for_each_rank(comm, tables, [&](int /*rank*/, SavedTables& own) { all.merge(own); });
  return all;
}

void broadcast_tables(MPI_Comm comm, SavedTables& tables) {
  SavedTables of_first = tables;
  broadcast_values(comm, 0, of_first);
  tables.merge(of_first);
}

std::vector<double> gather_parts(MPI_Comm comm, const std::vector<double>& parts) {
  const int count = static_cast<int>(parts.size());
  std::vector<double> table;
  if (rank_of(comm) == 0) table.resize(parts.size() * static_cast<std::size_t>(size_of(comm)));
  MPI_Gather(parts.data(), count, MPI_DOUBLE, table.data(), count, MPI_DOUBLE, 0, comm);
  return table;
}

std::vector<double> scatter_parts(MPI_Comm comm, const std::vector<double>& table,
                                  std::size_t columns) {
  std::vector<double> rows;
  if (rank_of(comm) == 0) {
    rows.assign(columns * static_cast<std::size_t>(size_of(comm)), 0.0);
    if (table.size() == rows.size()) {
      rows = table;
    } else {
      for (std::size_t i = 0; i < table.size(); ++i) rows[i % columns] += table[i];
    }
  }
  const int count = static_cast<int>(columns);
  std::vector<double> mine(columns);
  MPI_Scatter(rows.data(), count, MPI_DOUBLE, mine.data(), count, MPI_DOUBLE, 0, comm);
  return mine;
}

std::vector<double> gather_owned(MPI_Comm comm, std::span<const double> values) {
  return gathered(comm, std::vector<double>(values.begin(), values.end()));
}

std::vector<double> scatter_owned(MPI_Comm comm, const std::vector<double>& all,
                                  std::size_t count) {
  const std::vector<int> counts = gather_rows(comm, std::vector<int>{static_cast<int>(count)});
  std::vector<int> offsets(counts.size());
  std::exclusive_scan(counts.begin(), counts.end(), offsets.begin(), 0);
  std::vector<double> mine(count);
  MPI_Scatterv(all.data(), counts.data(), offsets.data(), MPI_DOUBLE, mine.data(),
               static_cast<int>(count), MPI_DOUBLE, 0, comm);
  return mine;
}

}  // namespace pounding
