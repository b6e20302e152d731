#include "output/saved_state_exchange.h"

#include "common/parallel.h"

namespace pounding {
namespace {

/// Tables as arrays that travel.
struct Parcel {
  std::vector<char> names;           ///< each ended by a zero
  std::vector<std::uint64_t> sizes;  ///< per table: columns, values
  std::vector<double> values;
};

Parcel pack(const SavedTables& tables) {
  Parcel parcel;
  for (const auto& [name, table] : tables) {
    parcel.names.insert(parcel.names.end(), name.begin(), name.end());
    parcel.names.push_back('\0');
    parcel.sizes.insert(parcel.sizes.end(), {table.columns, table.values.size()});
    parcel.values.insert(parcel.values.end(), table.values.begin(), table.values.end());
  }
  return parcel;
}

/// Adds the tables of a parcel to those there, which stay.
void unpack(const Parcel& parcel, SavedTables& tables) {
  const char* name = parcel.names.data();
  auto values = parcel.values.begin();
  for (std::size_t i = 0; i < parcel.sizes.size(); i += 2) {
    const auto end = values + static_cast<std::ptrdiff_t>(parcel.sizes[i + 1]);
    const std::string text(name);
    tables.try_emplace(text, SavedState::Table{parcel.sizes[i], {values, end}});
    name += text.size() + 1;
    values = end;
  }
}

}  // namespace

SavedTables collect_tables(MPI_Comm comm, const SavedTables& tables) {
  if (rank_of(comm) != 0) {
    const Parcel mine = pack(tables);
    send_array(comm, 0, mine.names);
    send_array(comm, 0, mine.sizes);
    send_array(comm, 0, mine.values);
    return {};
  }
  SavedTables all = tables;
  for (int rank = 1; rank < size_of(comm); ++rank) {
    Parcel parcel;
    receive_array(comm, rank, parcel.names);
    receive_array(comm, rank, parcel.sizes);
    receive_array(comm, rank, parcel.values);
    unpack(parcel, all);
  }
  return all;
}

void broadcast_tables(MPI_Comm comm, SavedTables& tables) {
  Parcel parcel = pack(tables);
  broadcast_values(comm, 0, parcel.names, parcel.sizes, parcel.values);
  unpack(parcel, tables);
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

namespace {

/// Values per rank and where each rank's begin; on rank 0.
struct Shares {
  std::vector<int> counts;
  std::vector<int> offsets;
  int total = 0;
};

Shares shares_of(MPI_Comm comm, int count) {
  Shares shares;
  shares.counts.resize(size_of(comm));
  MPI_Gather(&count, 1, MPI_INT, shares.counts.data(), 1, MPI_INT, 0, comm);
  for (const int of_rank : shares.counts) {
    shares.offsets.push_back(shares.total);
    shares.total += rank_of(comm) == 0 ? of_rank : 0;
  }
  return shares;
}

}  // namespace

std::vector<double> gather_owned(MPI_Comm comm, std::span<const double> values) {
  const int count = static_cast<int>(values.size());
  const Shares shares = shares_of(comm, count);
  std::vector<double> all(shares.total);
  MPI_Gatherv(values.data(), count, MPI_DOUBLE, all.data(), shares.counts.data(),
              shares.offsets.data(), MPI_DOUBLE, 0, comm);
  return all;
}

std::vector<double> scatter_owned(MPI_Comm comm, const std::vector<double>& all,
                                  std::size_t count) {
  const Shares shares = shares_of(comm, static_cast<int>(count));
  std::vector<double> mine(count);
  MPI_Scatterv(all.data(), shares.counts.data(), shares.offsets.data(), MPI_DOUBLE, mine.data(),
               static_cast<int>(count), MPI_DOUBLE, 0, comm);
  return mine;
}

}  // namespace pounding
