#include "driver/closing_watch.h"

#include <algorithm>
#include <cmath>

namespace pounding {
namespace {

/// Closings below this part of the gap are no motion.
constexpr double least_share = 1e-6;

}  // namespace

ClosingWatch::ClosingWatch(std::size_t contacts, const std::vector<interactions::Constraint>& rows,
                           std::span<const double> start_gaps)
    : start_gaps_(start_gaps.begin(), start_gaps.end()), closings_(contacts) {
  for (const interactions::Constraint& row : rows) contacts_.push_back(row.contact);
}

void ClosingWatch::look(std::span<const double> gaps) {
  for (std::size_t row = 0; row < gaps.size(); ++row) {
    const double start = start_gaps_[row];
    const double closing = start - gaps[row];
    if (start == interactions::open_gap || gaps[row] == interactions::open_gap || !(closing > 0)) {
      continue;
    }
    JointClosing& joint = closings_[contacts_[row]];
    joint.largest = std::max(joint.largest, closing);
    if (closing > least_share * start) {
      joint.factor = std::min(joint.factor, std::max(0.0, start) / closing);
    }
  }
}

void ClosingWatch::save(SavedState& saved) const {
  std::vector<double> numbers;
  for (const JointClosing& joint : closings_) {
    // A joint that never closes has no factor, and no infinite number goes into files.
    const bool closes = std::isfinite(joint.factor);
    numbers.insert(numbers.end(), {joint.largest, closes ? joint.factor : -1});
  }
  saved.put("joint_closings", numbers, 2);
}

void ClosingWatch::load(const SavedState& saved) {
  std::vector<double> numbers(2 * closings_.size());
  saved.get("joint_closings", numbers);
  for (std::size_t c = 0; c < closings_.size(); ++c) {
    closings_[c].largest = numbers[2 * c];
    if (numbers[2 * c + 1] >= 0) closings_[c].factor = numbers[2 * c + 1];
  }
}

}  // namespace pounding
