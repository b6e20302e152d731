#include "contact/interface_gather.h"

#include "common/parallel.h"

namespace pounding {

InterfaceGather::InterfaceGather(MPI_Comm comm, std::span<const int> mine) {
  int lowest = mine.empty() ? size_of(comm) : rank_of(comm);
  MPI_Allreduce(&lowest, &root_, 1, MPI_INT, MPI_MIN, comm);
  int counts = mine.empty() ? 0 : 1;
  MPI_Allreduce(&counts, &members_, 1, MPI_INT, MPI_SUM, comm);
  MPI_Comm_split(comm, mine.empty() ? MPI_UNDEFINED : 0, rank_of(comm), &comm_);
  if (!member()) {
    return;
  }
  const auto members = static_cast<std::size_t>(members_);
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
  order_.resize(static_cast<std::size_t>(total));
  MPI_Allgatherv(mine.data(), count, MPI_INT, order_.data(), counts_.data(), offsets_.data(),
                 MPI_INT, comm_);
  buffer_.resize(static_cast<std::size_t>(total * max_fields));
}

InterfaceGather::~InterfaceGather() {
  if (member()) {
    MPI_Comm_free(&comm_);
  }
}

void InterfaceGather::gather(int fields, std::span<const double> mine, std::span<double> all) {
  int total = 0;
  for (std::size_t m = 0; m < counts_.size(); ++m) {
    lengths_[m] = counts_[m] * fields;
    offsets_[m] = total;
    total += lengths_[m];
  }
  const double* gathered = mine.data();
  if (members_ > 1) {
    MPI_Allgatherv(mine.data(), static_cast<int>(mine.size()), MPI_DOUBLE, buffer_.data(),
                   lengths_.data(), offsets_.data(), MPI_DOUBLE, comm_);
    gathered = buffer_.data();
  }
  const std::size_t dofs = order_.size();
  const auto width = static_cast<std::size_t>(fields);
  for (std::size_t i = 0; i < dofs; ++i) {
    for (std::size_t f = 0; f < width; ++f) {
      all[f * dofs + static_cast<std::size_t>(order_[i])] = gathered[i * width + f];
    }
  }
}

void InterfaceGather::add(std::span<double> values) const {
  if (members_ > 1) {
    MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM,
                  comm_);
  }
}

}  // namespace pounding
