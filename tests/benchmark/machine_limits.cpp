// What the machine itself can do: multiply-adds, STREAM triad, messages. Answers commands on
// standard input, a line each, with a line of JSON each:
//
//   fma                    multiply-adds in registers, all ranks together [flop/s]
//   triad BYTES SECONDS    a = b + s c on arrays that fill BYTES together, over all ranks [B/s]
//   messages               one way between ranks 0 and 1 by length [s]; allreduce of one double [s]

#include <array>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <mpi.h>

#include "benchmark/command_loop.h"
#include "common/lanes.h"

namespace pounding::measuring {
namespace {

int ranks_of(MPI_Comm comm) {
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  return ranks;
}

/// Enough independent chains to hide the latency of a multiply-add.
double multiply_add(long repeats) {
  constexpr std::size_t chains = 12;
  std::array<Lanes, chains> x;
  for (std::size_t i = 0; i < chains; ++i) {
    x[i] = Lanes{1, 2, 3, 4} + static_cast<double>(i);
  }
  const Lanes factor = Lanes{} + 0.999999;
  const Lanes term = Lanes{} + 1e-6;
  for (long r = 0; r < repeats; ++r) {
#pragma GCC unroll 12
    for (std::size_t i = 0; i < chains; ++i) {
      x[i] = x[i] * factor + term;
    }
  }
  Lanes sum{};
  for (const Lanes& value : x) {
    sum += value;
  }
  return sum[0] + sum[1] + sum[2] + sum[3];
}

Json measure_multiply_add(MPI_Comm comm) {
  constexpr long repeats = 10'000'000;
  constexpr double operations = 2.0 * 12 * 4 * repeats;
  double result = 0;
  const double seconds = time_of(comm, [&] { result = multiply_add(repeats); });
  if (!(result > 0)) {
    throw std::logic_error("the multiply-adds went astray");
  }
  return {{"flops_per_second", operations * ranks_of(comm) / seconds}};
}

/// The arrays of one rank.
struct Triad {
  explicit Triad(std::size_t length) : a(length, 1), b(length, 2), c(length, 3) {}
  void run(long repeats) {
    const std::size_t n = a.size();
    for (long r = 0; r < repeats; ++r) {
      double* __restrict to = a.data();
      const double* __restrict from = b.data();
      const double* __restrict scaled = c.data();
      for (std::size_t i = 0; i < n; ++i) {
        to[i] = from[i] + 0.5 * scaled[i];
      }
      asm volatile("" : : "r"(to) : "memory");  // every repetition is carried out
    }
  }
  std::vector<double> a;
  std::vector<double> b;
  std::vector<double> c;
};

Json measure_triad(MPI_Comm comm, double bytes, double seconds) {
  constexpr double bytes_per_entry = 3 * sizeof(double);
  const auto length = static_cast<std::size_t>(bytes / bytes_per_entry / ranks_of(comm)) + 1;
  Triad triad(length);
  triad.run(1);
  const double once = time_of(comm, [&] { triad.run(1); });
  const long repeats = repetitions(comm, seconds, once);
  const double total = time_of(comm, [&] { triad.run(repeats); });
  const double moved = bytes_per_entry * static_cast<double>(length) * ranks_of(comm);
  return {{"bytes", moved}, {"bytes_per_second", moved * static_cast<double>(repeats) / total}};
}

/// Time of one message from rank 0 to 1 or back [s].
double one_way(MPI_Comm comm, int rank, std::vector<char>& buffer, long exchanges) {
  const int length = static_cast<int>(buffer.size());
  const double seconds = time_of(comm, [&] {
    for (long i = 0; i < exchanges && rank < 2; ++i) {
      if (rank == 0) {
        MPI_Send(buffer.data(), length, MPI_CHAR, 1, 0, comm);
        MPI_Recv(buffer.data(), length, MPI_CHAR, 1, 0, comm, MPI_STATUS_IGNORE);
      } else {
        MPI_Recv(buffer.data(), length, MPI_CHAR, 0, 0, comm, MPI_STATUS_IGNORE);
        MPI_Send(buffer.data(), length, MPI_CHAR, 0, 0, comm);
      }
    }
  });
  return seconds / (2 * static_cast<double>(exchanges));
}

Json measure_messages(MPI_Comm comm) {
  constexpr std::size_t shortest = 8;
  constexpr std::size_t longest = 1 << 20;
  constexpr double lasting = 0.02;  // [s] per length
  if (ranks_of(comm) < 2) {
    throw std::invalid_argument("messages need two ranks");
  }
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  Json lengths = Json::array();
  Json times = Json::array();
  for (std::size_t length = shortest; length <= longest; length *= 2) {
    std::vector<char> buffer(length, 1);
    const double guess = one_way(comm, rank, buffer, 20);
    const long exchanges = repetitions(comm, lasting, 2 * guess);
    lengths.push_back(length);
    times.push_back(one_way(comm, rank, buffer, exchanges));
  }
  constexpr int reductions = 20000;
  double value = 1;
  const double seconds = time_of(comm, [&] {
    for (int i = 0; i < reductions; ++i) {
      MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MIN, comm);
    }
  });
  return {{"bytes", lengths}, {"seconds", times}, {"allreduce_seconds", seconds / reductions}};
}

Json measure(MPI_Comm comm, const std::string& line) {
  std::istringstream words(line);
  std::string what;
  words >> what;
  if (what == "fma") {
    return measure_multiply_add(comm);
  }
  if (what == "messages") {
    return measure_messages(comm);
  }
  double bytes = 0;
  double seconds = 0;
  words >> bytes >> seconds;
  if (what != "triad" || !(bytes > 0) || !(seconds > 0)) {
    throw std::invalid_argument("cannot measure '" + line + "'");
  }
  return measure_triad(comm, bytes, seconds);
}

}  // namespace
}  // namespace pounding::measuring

int main(int count, char** words) {
  using namespace pounding::measuring;
  MPI_Init(&count, &words);
  try {
    answer(MPI_COMM_WORLD, {{"ranks", ranks_of(MPI_COMM_WORLD)}});
    serve(MPI_COMM_WORLD, [](const std::string& line) { return measure(MPI_COMM_WORLD, line); });
  } catch (const std::exception& error) {
    std::fprintf(stderr, "machine_limits: %s\n", error.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  MPI_Finalize();
}
