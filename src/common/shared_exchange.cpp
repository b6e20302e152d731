#include "common/shared_exchange.h"

#include <algorithm>
#include <array>
#include <fcntl.h>
#include <numeric>
#include <sched.h>
#include <string>
#include <sys/mman.h>
#include <thread>
#include <time.h>
#include <unistd.h>

#include "common/parallel.h"

namespace pounding {
namespace {

constexpr std::size_t line = 128;  // [B] a cache line and the one that is fetched with it

constexpr int least_patience = 100;  // looks
constexpr int short_wait = 20;       // times the processor was given away
constexpr timespec nap{0, 20'000};   // the kernel adds 50 microseconds to it

using Turn = std::atomic<std::uint64_t>;
static_assert(Turn::is_always_lock_free, "turns are read by other processes");

std::size_t rounded_up(std::size_t bytes) {
  return (bytes + line - 1) / line * line;
}

std::size_t board_size(std::size_t capacity) {
  return line + 2 * rounded_up(capacity * sizeof(double));
}

/// Memory behind an open file; null if the system gives none.
void* map_memory(int file, std::size_t size) {
  void* const memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  return memory == MAP_FAILED ? nullptr : memory;
}

/// Maps the same memory on all ranks, zeros; null on all if one gets none. It has no name, so that
/// nothing is left of it however the ranks end: the others find it among rank 0's open files. A
/// window of MPI_Win_allocate_shared is freed by all ranks together, so that one that is out of
/// memory would wait for the others on its way out (`faults_test.py`).
void* common_memory(MPI_Comm comm, std::size_t size) {
  std::array<long, 2> place{static_cast<long>(getpid()), -1};  // process and file
  int file = -1;
  if (rank_of(comm) == 0) {
    file = memfd_create("pounding", MFD_CLOEXEC);
    if (file >= 0 && posix_fallocate(file, 0, static_cast<off_t>(size)) == 0) place[1] = file;
  }
  MPI_Bcast(place.data(), 2, MPI_LONG, 0, comm);
  if (rank_of(comm) != 0 && place[1] >= 0) {
    const std::string path =
        "/proc/" + std::to_string(place[0]) + "/fd/" + std::to_string(place[1]);
    file = open(path.c_str(), O_RDWR | O_CLOEXEC);
  }
  void* memory = file >= 0 && place[1] >= 0 ? map_memory(file, size) : nullptr;
  int everybody = memory != nullptr ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &everybody, 1, MPI_INT, MPI_MIN, comm);
  if (file >= 0) close(file);
  if (everybody == 0 && memory != nullptr) {
    munmap(memory, size);
    memory = nullptr;
  }
  return memory;
}

/// Decides alike on all ranks.
bool on_one_node(MPI_Comm comm) {
  MPI_Comm node = MPI_COMM_NULL;
  MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, rank_of(comm), MPI_INFO_NULL, &node);
  const bool all = size_of(node) == size_of(comm);
  MPI_Comm_free(&node);
  return all;
}

void pause_shortly() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

SharedExchange::SharedExchange(MPI_Comm comm, std::size_t capacity)
    : comm_(comm), rank_(static_cast<std::size_t>(rank_of(comm))) {
  if (!on_one_node(comm)) return;
  const std::size_t ranks = size_of(comm);
  const unsigned long size = board_size(capacity);
  std::vector<unsigned long> begin(ranks + 1, 0);
  MPI_Allgather(&size, 1, MPI_UNSIGNED_LONG, begin.data() + 1, 1, MPI_UNSIGNED_LONG, comm);
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  memory_size_ = begin.back();
  memory_ = common_memory(comm, memory_size_);
  for (std::size_t r = 0; memory_ != nullptr && r < ranks; ++r) {
    char* const first = static_cast<char*>(memory_) + begin[r];
    const std::size_t half = (begin[r + 1] - begin[r] - line) / 2;
    boards_.push_back({reinterpret_cast<Turn*>(first),
                       {reinterpret_cast<double*>(first + line),
                        reinterpret_cast<double*>(first + line + half)}});
  }
  // Where ranks share processors, the one that is waited for may need this one.
  const bool crowded = crowded_node() || ranks > std::thread::hardware_concurrency();
  most_patience_ = crowded ? least_patience : 10000;
  patience_ = most_patience_;
}

SharedExchange::~SharedExchange() {
  if (memory_ != nullptr) munmap(memory_, memory_size_);
}

void SharedExchange::publish(std::span<const double> values) {
  std::copy(values.begin(), values.end(), draft());
  publish();
}

void SharedExchange::publish() {
  boards_[rank_].turn->store(++turn_, std::memory_order_release);
}

void SharedExchange::give_way(int n) const {
  if (n > short_wait && load_.is_above_processors()) {
    nanosleep(&nap, nullptr);
  } else {
    sched_yield();
  }
}

const double* SharedExchange::wait_for(int rank) const {
  const Board& board = boards_[rank];
  int looks = 0;
  for (; board.turn->load(std::memory_order_acquire) < turn_; ++looks) {
    if (looks < patience_) {
      pause_shortly();
    } else {
      // It may wait for a message that this rank has still to push on.
      int found = 0;
      MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, comm_, &found, MPI_STATUS_IGNORE);
      give_way(looks - patience_);
    }
  }
  patience_ =
      looks > patience_ + short_wait ? least_patience : std::min(2 * patience_, most_patience_);
  return board.values[turn_ % 2];
}

}  // namespace pounding
