#include "interactions/interface_gather.h"

#include <algorithm>

#include "common/parallel.h"

namespace pounding::interactions {
namespace {

/// Values that are added up through common memory; more travel in a message.
constexpr std::size_t most_added = 64;

}  // namespace

InterfaceGather::InterfaceGather(MPI_Comm comm, std::span<const int> mine, bool common_memory) {
  int lowest = mine.empty() ? size_of(comm) : rank_of(comm);
  MPI_Allreduce(&lowest, &root_, 1, MPI_INT, MPI_MIN, comm);
  int counts = mine.empty() ? 0 : 1;
  MPI_Allreduce(&counts, &members_, 1, MPI_INT, MPI_SUM, comm);
  MPI_Comm_split(comm, mine.empty() ? MPI_UNDEFINED : 0, rank_of(comm), &comm_);
  if (!member()) return;
  const std::size_t members = members_;
  counts_.resize(members);
  lengths_.resize(members);
  offsets_.resize(members);
  const int count = static_cast<int>(mine.size());
  MPI_Allgather(&count, 1, MPI_INT, counts_.data(), 1, MPI_INT, comm_);
  int total = 0;
  for (std::size_t m = 0; m < members; ++m) {
    offsets_[m] = total;
    total += counts_[m];
  }
  order_.resize(total);
  MPI_Allgatherv(mine.data(), count, MPI_INT, order_.data(), counts_.data(), offsets_.data(),
                 MPI_INT, comm_);
  if (common_memory && members_ > 1) {
    shared_ = std::make_unique<SharedExchange>(
        comm_, std::max(mine.size() * static_cast<std::size_t>(max_fields), most_added));
    if (!shared_->works()) shared_.reset();
  }
  buffer_.resize(shared_ ? 0 : static_cast<std::size_t>(total * max_fields));
}

InterfaceGather::~InterfaceGather() {
  if (member()) MPI_Comm_free(&comm_);
}

/// Puts values of the gathered dofs from `first` on in their places.
void InterfaceGather::spread(int fields, std::size_t first, std::size_t end, const double* values,
                             std::span<double> all) const {
  const std::size_t dofs = order_.size();
  for (std::size_t i = first; i < end; ++i) {
    for (std::size_t f = 0; f < static_cast<std::size_t>(fields); ++f) {
      all[f * dofs + static_cast<std::size_t>(order_[i])] = *values++;
    }
  }
}

void InterfaceGather::gather(int fields, std::span<const double> mine, std::span<double> all) {
  if (members_ == 1) {
    spread(fields, 0, order_.size(), mine.data(), all);
    return;
  }
  if (shared_) {
    shared_->publish(mine);
    std::size_t first = 0;
    for (int m = 0; m < members_; ++m) {
      const std::size_t end = first + static_cast<std::size_t>(counts_[m]);
      spread(fields, first, end, shared_->wait_for(m), all);
      first = end;
    }
    return;
  }
  int total = 0;
  for (std::size_t m = 0; m < counts_.size(); ++m) {
    lengths_[m] = counts_[m] * fields;
    offsets_[m] = total;
    total += lengths_[m];
  }
  MPI_Allgatherv(mine.data(), static_cast<int>(mine.size()), MPI_DOUBLE, buffer_.data(),
                 lengths_.data(), offsets_.data(), MPI_DOUBLE, comm_);
  spread(fields, 0, order_.size(), buffer_.data(), all);
}

void InterfaceGather::add(std::span<double> values) {
  if (members_ == 1) return;
  if (shared_ && values.size() <= most_added) {
    shared_->publish(values);
    std::fill(values.begin(), values.end(), 0.0);
    for (int m = 0; m < members_; ++m) {
      const double* const theirs = shared_->wait_for(m);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] += theirs[i];
    }
    return;
  }
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM,
                comm_);
}

}  // namespace pounding::interactions
