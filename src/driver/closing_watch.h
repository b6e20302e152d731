#pragma once

#include <limits>
#include <span>
#include <vector>

#include "common/saved_state.h"
#include "interactions/pairing/interface.h"

namespace pounding {

/// How far the pairs of a contact have closed since the start of a run.
struct JointClosing {
  double largest = 0;  ///< of all pairs [m]
  /// Least over the pairs of gap at the start over closing: as long as everything stays linear, a
  /// motion so many times as strong just closes the first of them [-]. Infinite where none closes.
  double factor = std::numeric_limits<double>::infinity();
};

/// Looks at the gaps of every pair with the samples of a run. On the rank that knows the gaps.
class ClosingWatch {
 public:
  /// `start_gaps`: per row of the interface [m].
  ClosingWatch(std::size_t contacts, const std::vector<interactions::Constraint>& rows,
               std::span<const double> start_gaps);
  /// Gaps per row [m].
  void look(std::span<const double> gaps);
  const std::vector<JointClosing>& closings() const { return closings_; }  ///< per contact

  void save(SavedState& saved) const;
  void load(const SavedState& saved);

 private:
  std::vector<int> contacts_;       ///< per row
  std::vector<double> start_gaps_;  ///< per row [m]
  std::vector<JointClosing> closings_;
};

}  // namespace pounding
