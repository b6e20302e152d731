#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <mpi.h>

#include "common/byte_stream.h"

/// Agreement between ranks: no rank fails alone inside a collective.
namespace pounding {

int rank_of(MPI_Comm comm);
int size_of(MPI_Comm comm);

/// Message about a std::bad_alloc on a rank, one line.
std::string out_of_memory(int rank);

/// The string of rank 0 on every rank. Collective.
void broadcast(MPI_Comm comm, std::string& text);

/// Runs `work` on rank 0 only. If it throws, every rank throws the same error (UserError stays
/// UserError, std::bad_alloc becomes one, anything else std::runtime_error). Collective.
void on_rank0(MPI_Comm comm, const std::function<void()>& work);

/// Runs `work` on every rank; if any rank throws, every rank throws the error of the lowest one
/// that did. `work` must not communicate. Collective.
void on_every_rank(MPI_Comm comm, const std::function<void()>& work);

/// Values in portions whose length is an int.
template <typename Value, typename Take>
void in_portions(std::span<Value> values, const Take& take) {
  constexpr std::size_t most = std::size_t{1} << 30;
  for (; !values.empty(); values = values.subspan(std::min(values.size(), most))) {
    take(values.data(), static_cast<int>(std::min(values.size(), most)));
  }
}

/// Sends and receives an array of plain values of any length.
template <typename Value>
void send_array(MPI_Comm comm, int to, const std::vector<Value>& values) {
  const long count = static_cast<long>(values.size());
  MPI_Send(&count, 1, MPI_LONG, to, 0, comm);
  in_portions(std::as_bytes(std::span(values)), [&](const std::byte* first, int size) {
    MPI_Send(first, size, MPI_BYTE, to, 1, comm);
  });
}

template <typename Value>
void receive_array(MPI_Comm comm, int from, std::vector<Value>& values) {
  long count = 0;
  MPI_Recv(&count, 1, MPI_LONG, from, 0, comm, MPI_STATUS_IGNORE);
  values.resize(count);
  in_portions(std::as_writable_bytes(std::span(values)), [&](std::byte* first, int size) {
    MPI_Recv(first, size, MPI_BYTE, from, 1, comm, MPI_STATUS_IGNORE);
  });
}

/// The array of rank `root` on every rank, of any length. Collective.
template <typename Value, typename Allocator>
void broadcast_array(MPI_Comm comm, std::vector<Value, Allocator>& values, int root = 0) {
  long count = static_cast<long>(values.size());
  MPI_Bcast(&count, 1, MPI_LONG, root, comm);
  values.resize(count);
  in_portions(std::as_writable_bytes(std::span(values)),
              [&](std::byte* first, int size) { MPI_Bcast(first, size, MPI_BYTE, root, comm); });
}

/// Values as bytes, see byte_stream.h, and back.
template <typename... Values>
std::vector<char> bytes_of(const Values&... values) {
  std::vector<char> bytes;
  const WriteBytes take = [&](std::span<const char> next) {
    bytes.insert(bytes.end(), next.begin(), next.end());
  };
  ByteWriter{take}(values...);
  return bytes;
}

template <typename... Values>
void from_bytes(const std::vector<char>& bytes, Values&... values) {
  std::size_t place = 0;
  const ReadBytes give = [&](std::span<char> next) {
    std::copy_n(bytes.data() + place, next.size(), next.data());
    place += next.size();
  };
  ByteReader{give, bytes.size()}(values...);
}

/// Values of rank `root`, which a byte stream takes, on every rank; where no rank is the root, each
/// keeps those that it has. Collective.
template <typename... Values>
void broadcast_values(MPI_Comm comm, int root, Values&... values) {
  if (root < 0 || root >= size_of(comm)) return;
  const bool writes = rank_of(comm) == root;
  std::vector<char> bytes;
  if (writes) bytes = bytes_of(values...);
  broadcast_array(comm, bytes, root);
  if (!writes) from_bytes(bytes, values...);
}

/// Calls `use` on rank 0 with every rank and its value, which a byte stream takes, in the order of
/// the ranks. Collective.
template <typename Value, typename Use>
void for_each_rank(MPI_Comm comm, Value mine, const Use& use) {
  if (rank_of(comm) != 0) return send_array(comm, 0, bytes_of(mine));
  use(0, mine);
  for (int rank = 1; rank < size_of(comm); ++rank) {
    std::vector<char> bytes;
    receive_array(comm, rank, bytes);
    from_bytes(bytes, mine);
    use(rank, mine);
  }
}

/// MPI's type of a number.
template <typename Number>
MPI_Datatype mpi_type() {
  if constexpr (std::is_same_v<Number, double>) return MPI_DOUBLE;
  if constexpr (std::is_same_v<Number, int>) return MPI_INT;
  if constexpr (std::is_same_v<Number, std::int64_t>) return MPI_INT64_T;
  if constexpr (std::is_same_v<Number, std::uint8_t>) return MPI_UINT8_T;
}

/// Replaces each number, and each number of an array, by the sum of those of all ranks (MPI_SUM),
/// the smallest or the largest one. Collective.
template <typename... Values>
void reduce_over_ranks(MPI_Comm comm, MPI_Op operation, Values&&... values) {
  const auto reduce = [&]<typename Number>(std::span<Number> numbers) {
    constexpr std::size_t most = std::size_t{1} << 30;  // the length of a portion is an int
    for (std::size_t first = 0; first < numbers.size(); first += most) {
      MPI_Allreduce(MPI_IN_PLACE, &numbers[first],
                    static_cast<int>(std::min(most, numbers.size() - first)), mpi_type<Number>(),
                    operation, comm);
    }
  };
  const auto take = [&](auto& value) {
    if constexpr (std::is_arithmetic_v<std::remove_reference_t<decltype(value)>>) {
      reduce(std::span(&value, 1));
    } else {
      reduce(std::span<std::remove_reference_t<decltype(value[0])>>(value));
    }
  };
  (take(values), ...);
}

/// Whether something is so on any rank, the same on all of them. Collective.
inline bool on_any_rank(MPI_Comm comm, bool here) {
  int any = here ? 1 : 0;
  reduce_over_ranks(comm, MPI_MAX, any);
  return any != 0;
}

/// The extreme value over the ranks, MPI_MAXLOC or MPI_MINLOC, and the name on the rank that has
/// it. Collective.
void share_extreme(MPI_Comm comm, MPI_Op extreme, double& value, std::string& name);

/// Values of all ranks on rank 0, in the order of the ranks; nothing elsewhere. Collective.
template <typename Value>
std::vector<Value> gathered(MPI_Comm comm, std::vector<Value> mine) {
  std::vector<Value> all;
  for_each_rank(comm, std::move(mine), [&](int /*rank*/, const std::vector<Value>& values) {
    all.insert(all.end(), values.begin(), values.end());
  });
  return all;
}

/// Where the part of each rank begins, of parts of so many rows one behind the other.
inline std::vector<int> starts_of(std::span<const int> counts) {
  std::vector<int> starts(counts.size());
  std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
  return starts;
}

/// Plain values of all ranks, one after the other, on all of them. Collective.
template <typename Value>
std::vector<Value> gather_rows(MPI_Comm comm, const std::vector<Value>& rows) {
  const auto ranks = static_cast<std::size_t>(size_of(comm));
  const int count = static_cast<int>(rows.size());
  std::vector<int> counts(ranks);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  const std::vector<int> begins = starts_of(counts);
  std::vector<Value> all(static_cast<std::size_t>(begins.back() + counts.back()));
  MPI_Datatype value = MPI_DATATYPE_NULL;
  MPI_Type_contiguous(sizeof(Value), MPI_BYTE, &value);
  MPI_Type_commit(&value);
  MPI_Allgatherv(rows.data(), count, value, all.data(), counts.data(), begins.data(), value, comm);
  MPI_Type_free(&value);
  return all;
}

}  // namespace pounding
