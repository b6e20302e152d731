#include "modal/chosen_modes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/parallel.h"

namespace pounding {
namespace {

/// phi^2 / omega^2 of each mode at a dof of this rank, relative to the sum of all phi^2 there.
void add_shares(const OrthonormalSpace& space, std::span<const double> squared_frequency,
                LocalIndex dof, std::vector<double>& share) {
  double sum = 0;
  for (std::size_t j = 0; dof >= 0 && j < share.size(); ++j) {
    sum += std::pow(space.column(j)[dof], 2);
  }
  for (std::size_t j = 0; sum > 0 && j < share.size(); ++j) {
    const double square = std::max(squared_frequency[j], 1e-6);  // rigid motions are all alike
    share[j] += std::pow(space.column(j)[dof], 2) / (square * sum);
  }
}

}  // namespace

std::vector<std::size_t> moving_most(MPI_Comm comm, const Mesh& mesh, const ModalRequest& request,
                                     const OrthonormalSpace& space,
                                     std::span<const double> squared_frequency,
                                     std::size_t wanted) {
  std::vector<double> share(space.size(), 0.0);
  for (const auto* points : {&request.contact_points, &request.other_points}) {
    for (const TracePoint& point : *points) {
      add_shares(space, squared_frequency, mesh.owned_dof(point.node, point.component), share);
    }
  }
  reduce_over_ranks(comm, MPI_SUM, share);
  std::vector<std::size_t> order(space.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto first = order.begin() + static_cast<std::ptrdiff_t>(wanted * 3 / 4);
  std::stable_sort(first, order.end(),
                   [&](std::size_t a, std::size_t b) { return share[a] > share[b]; });
  order.resize(wanted);
  std::ranges::sort(order);
  return order;
}

}  // namespace pounding
