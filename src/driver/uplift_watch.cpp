#include "driver/uplift_watch.h"

namespace pounding {

void UpliftWatch::look(const Solver& solver, double interval) {
  std::vector<double> sums;  // pressed and all, structure by structure
  for (std::size_t s = 0; s < ratios_.size(); ++s) {
    const interactions::StructureLinks* const links = solver.links(s);
    const auto bedding =
        links != nullptr ? links->bedding() : interactions::StructureLinks::Bedding{};
    sums.insert(sums.end(), {bedding.pressed, bedding.all});
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                comm_);
  for (std::size_t s = 0; s < ratios_.size(); ++s) {
    if (!(sums[2 * s + 1] > 0)) continue;
    ContactRatio& ratio = ratios_[s];
    ratio.now = sums[2 * s] / sums[2 * s + 1];
    if (ratio.now < ContactRatio::low) ratio.low_duration += interval;
    if (ratio.now < ratio.smallest) {
      ratio.smallest = ratio.now;
      ratio.time = solver.stepper().time();
    }
  }
}

void UpliftWatch::save(SavedState& saved) const {
  std::vector<double> numbers;
  for (const ContactRatio& ratio : ratios_) {
    numbers.insert(numbers.end(), {ratio.now, ratio.smallest, ratio.time, ratio.low_duration});
  }
  saved.put("contact_ratio", numbers);
}

void UpliftWatch::load(const SavedState& saved) {
  std::vector<double> numbers(4 * ratios_.size());
  saved.get("contact_ratio", numbers);
  for (std::size_t s = 0; s < ratios_.size(); ++s) {
    const double* const of = &numbers[4 * s];
    ratios_[s] = {of[0], of[1], of[2], of[3]};
  }
}

}  // namespace pounding
