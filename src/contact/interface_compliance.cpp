#include "contact/interface_compliance.h"

namespace pounding {

InterfaceCompliance::InterfaceCompliance(MPI_Comm comm, const std::vector<InterfaceDof>& dofs,
                                         std::span<Trace> traces)
    : diagonal_(dofs.size(), 0.0),
      block_of_(dofs.size(), -1),
      row_begin_(dofs.size(), 0),
      members_(traces.size()) {
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    std::vector<int>& members = members_[dofs[i].structure];
    place_.push_back(members.size());
    members.push_back(static_cast<int>(i));
  }
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const std::size_t s = dofs[i].structure;
    group_of_.push_back(static_cast<int>(i));
    if (traces[s].is_coupled()) {
      block_of_[i] = dofs[i].structure;
      group_of_[i] = members_[s].front();
      row_begin_[i] = blocks_.size();
      blocks_.resize(blocks_.size() + members_[s].size(), 0.0);
    }
  }
  for (std::size_t s = 0; s < traces.size(); ++s) {
    const std::vector<int>& known = traces[s].known();
    for (std::size_t a = 0; a < known.size(); ++a) {
      const std::size_t row = members_[s][known[a]];
      diagonal_[row] = traces[s].compliance(a, a);
      for (std::size_t b = 0; traces[s].is_coupled() && b < known.size(); ++b) {
        blocks_[row_begin_[row] + static_cast<std::size_t>(known[b])] = traces[s].compliance(a, b);
      }
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, diagonal_.data(), static_cast<int>(diagonal_.size()), MPI_DOUBLE,
                MPI_SUM, comm);
  MPI_Allreduce(MPI_IN_PLACE, blocks_.data(), static_cast<int>(blocks_.size()), MPI_DOUBLE, MPI_SUM,
                comm);
}

double InterfaceCompliance::velocity_change(std::size_t a, std::span<const double> f) const {
  if (block_of_[a] < 0) return diagonal_[a] * f[a];
  const std::vector<int>& members = members_[block_of_[a]];
  double sum = 0;
  for (std::size_t b = 0; b < members.size(); ++b) {
    sum += blocks_[row_begin_[a] + b] * f[members[b]];
  }
  return sum;
}

}  // namespace pounding
