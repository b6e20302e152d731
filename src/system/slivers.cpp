#include "system/slivers.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "common/parallel.h"
#include "common/series.h"
#include "mesh/location.h"

namespace pounding {
namespace {

constexpr double share_of_median = 0.1;  // below it an element is a sliver
constexpr double equal = 1e-6;           // relative: how well equal shapes agree

struct Range {
  double smallest = std::numeric_limits<double>::infinity();
  double largest = 0;
};

/// Over all ranks. Collective.
Range range_of(MPI_Comm comm, std::span<const double> time_steps) {
  Range range;
  for (const double dt : time_steps) {
    range.smallest = std::min(range.smallest, dt);
    range.largest = std::max(range.largest, dt);
  }
  reduce_over_ranks(comm, MPI_MIN, range.smallest);
  reduce_over_ranks(comm, MPI_MAX, range.largest);
  return range;
}

/// Every element counted once, over all ranks: the upper one of two in the middle. Collective.
double median_of(MPI_Comm comm, const ElementBlock& block, std::span<const double> time_steps) {
  std::vector<double> values;
  for (std::size_t e = 0; e < block.count(); ++e) {
    if (block.counted[e] != 0) values.push_back(time_steps[e]);
  }
  values = gathered(comm, std::move(values));
  double middle = rank_of(comm) == 0 ? median(std::move(values)) : 0;
  MPI_Bcast(&middle, 1, MPI_DOUBLE, 0, comm);
  return middle;
}

GlobalIndex count_below(MPI_Comm comm, const ElementBlock& block,
                        std::span<const double> time_steps, double limit) {
  GlobalIndex count = 0;
  for (std::size_t e = 0; e < block.count(); ++e) {
    count += block.counted[e] != 0 && time_steps[e] < limit ? 1 : 0;
  }
  reduce_over_ranks(comm, MPI_SUM, count);
  return count;
}

/// The element with the lowest tag of those at or below a limit. Collective.
std::string first_at_most(const Mesh& mesh, const ElementBlock& block,
                          std::span<const double> time_steps, double limit) {
  std::int64_t first = std::numeric_limits<std::int64_t>::max();
  std::string name;
  for (std::size_t e = 0; e < block.count(); ++e) {
    if (time_steps[e] <= limit && block.tags[e] < first) {
      first = block.tags[e];
      name = describe_element(mesh, block, e);
    }
  }
  auto tag = static_cast<double>(first);
  share_extreme(mesh.comm, MPI_MINLOC, tag, name);
  return name;
}

}  // namespace

std::optional<Sliver> find_sliver(const Mesh& mesh, const ElementBlock& block,
                                  std::span<const double> time_steps) {
  const Range range = range_of(mesh.comm, time_steps);
  if (!(range.smallest < share_of_median * range.largest)) return std::nullopt;
  const double median = median_of(mesh.comm, block, time_steps);
  const double limit = share_of_median * median;
  if (!(range.smallest < limit)) return std::nullopt;
  return Sliver{first_at_most(mesh, block, time_steps, range.smallest * (1 + equal)),
                count_below(mesh.comm, block, time_steps, limit), range.smallest, median};
}

}  // namespace pounding
