#include "stiffness/common_values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "common/parallel.h"

namespace pounding::stiffness {
namespace {

constexpr std::size_t most_ranges = 10000;  // per rank; a mesh without equal elements has no use

}  // namespace

void CommonValues::add(double value) {
  if (!too_many_) add_range(value, value);
}

void CommonValues::add_range(double low, double high) {
  // Starts from the first range that ends no farther than the tolerance below.
  auto range = ranges_.upper_bound(low);
  while (range != ranges_.begin() && std::prev(range)->second >= low - tolerance_) --range;
  while (range != ranges_.end() && range->first <= high + tolerance_) {
    low = std::min(low, range->first);
    high = std::max(high, range->second);
    range = ranges_.erase(range);
  }
  ranges_[low] = high;
  too_many_ = ranges_.size() > most_ranges;
}

void CommonValues::agree(MPI_Comm comm) {
  int too_many = too_many_ ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &too_many, 1, MPI_INT, MPI_MAX, comm);
  too_many_ = too_many != 0;
  if (too_many_) {
    ranges_.clear();
    return;
  }
  std::vector<double> mine;
  for (const auto& [low, high] : ranges_) mine.insert(mine.end(), {low, high});
  const auto count = static_cast<int>(mine.size());
  std::vector<int> counts(size_of(comm));
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  std::vector<int> starts(counts.size(), 0);
  for (std::size_t r = 1; r < counts.size(); ++r) starts[r] = starts[r - 1] + counts[r - 1];
  std::vector<double> all(starts.back() + counts.back());
  MPI_Allgatherv(mine.data(), count, MPI_DOUBLE, all.data(), counts.data(), starts.data(),
                 MPI_DOUBLE, comm);
  for (std::size_t i = 0; i < all.size(); i += 2) add_range(all[i], all[i + 1]);
  too_many_ = false;
}

double CommonValues::operator()(double value) const {
  if (too_many_) return std::round(value / tolerance_) * tolerance_;
  const auto range = std::prev(ranges_.upper_bound(value));
  return range->first + (range->second - range->first) / 2;
}

}  // namespace pounding::stiffness
