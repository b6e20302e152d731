#include "mesh/halo.h"

#include <algorithm>

#include "common/parallel.h"

namespace pounding {
namespace {

constexpr int halo_tag = 1;

}  // namespace

Halo::Halo(MPI_Comm comm, GlobalIndex first_owned, LocalIndex owned_count,
           std::span<const GlobalIndex> ghosts, bool common_memory) {
  MPI_Comm_dup(comm, &comm_);
  const std::size_t ranks = size_of(comm_);
  std::vector<GlobalIndex> ends(ranks);
  const GlobalIndex end = first_owned + owned_count;
  MPI_Allgather(&end, 1, MPI_INT64_T, ends.data(), 1, MPI_INT64_T, comm_);
  std::vector<int> needed(ranks, 0);  // ghosts per owner
  std::vector<std::size_t> owner(ghosts.size());
  for (std::size_t i = 0; i < ghosts.size(); ++i) {
    owner[i] = static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), ghosts[i]) -
                                        ends.begin());
    ++needed[owner[i]];
  }
  const std::vector<int> receive_start = starts_of(needed);
  std::vector<int> next = receive_start;
  std::vector<GlobalIndex> wanted(ghosts.size());
  slot_.resize(ghosts.size());
  for (std::size_t i = 0; i < ghosts.size(); ++i) {
    slot_[i] = next[owner[i]]++;
    wanted[slot_[i]] = ghosts[i];
  }

  std::vector<int> given(ranks, 0);  // owned dofs per rank that needs them
  MPI_Alltoall(needed.data(), 1, MPI_INT, given.data(), 1, MPI_INT, comm_);
  const std::vector<int> send_start = starts_of(given);
  std::vector<GlobalIndex> asked(send_start.back() + given.back());
  MPI_Alltoallv(wanted.data(), needed.data(), receive_start.data(), MPI_INT64_T, asked.data(),
                given.data(), send_start.data(), MPI_INT64_T, comm_);
  for (const GlobalIndex dof : asked) {
    sent_dofs_.push_back(static_cast<LocalIndex>(dof - first_owned));
  }
  received_.resize(ghosts.size());
  std::vector<int> their_start(ranks, 0);
  MPI_Alltoall(send_start.data(), 1, MPI_INT, their_start.data(), 1, MPI_INT, comm_);
  for (std::size_t r = 0; r < ranks; ++r) {
    if (needed[r] == 0 && given[r] == 0) continue;
    neighbours_.push_back({static_cast<int>(r), needed[r], receive_start[r], given[r],
                           send_start[r], their_start[r]});
  }
  if (on_any_rank(comm_, !neighbours_.empty()) && common_memory) {
    shared_ = std::make_unique<SharedExchange>(comm_, sent_dofs_.size());
    if (!shared_->works()) shared_.reset();
  }
  if (!shared_) prepare_messages();
}

void Halo::prepare_messages() {
  send_.resize(sent_dofs_.size());
  for (const Neighbour& other : neighbours_) {
    if (other.received > 0) {
      MPI_Recv_init(received_.data() + other.received_begin, other.received, MPI_DOUBLE, other.rank,
                    halo_tag, comm_, &requests_.emplace_back());
    }
  }
  for (const Neighbour& other : neighbours_) {
    if (other.sent > 0) {
      MPI_Send_init(send_.data() + other.sent_begin, other.sent, MPI_DOUBLE, other.rank, halo_tag,
                    comm_, &requests_.emplace_back());
    }
  }
}

Halo::~Halo() {
  for (MPI_Request& request : requests_) MPI_Request_free(&request);
  MPI_Comm_free(&comm_);
}

void Halo::start() {
  if (shared_) {
    shared_->publish();
  } else if (!requests_.empty()) {
    MPI_Startall(static_cast<int>(requests_.size()), requests_.data());
  }
}

void Halo::end() {
  if (shared_) {
    for (const Neighbour& other : neighbours_) {
      const double* const theirs = shared_->wait_for(other.rank) + other.their_begin;
      std::copy(theirs, theirs + other.received, received_.begin() + other.received_begin);
    }
  } else if (!requests_.empty()) {
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  }
}

}  // namespace pounding
