#pragma once

#include <span>
#include <vector>

namespace pounding {

/// Products K u of single elements, whose matrices may have any size.
class ElementProducts {
 public:
  /// Adds an element's K, row by row.
  void add(std::span<const double> stiffness) {
    begin_.push_back(values_.size());
    values_.insert(values_.end(), stiffness.begin(), stiffness.end());
  }

  /// f = K u of an element, in the order in which they were added; as many numbers as its K has
  /// rows.
  void apply(std::size_t element, std::span<const double> u, std::span<double> f) const {
    const double* row = &values_[begin_[element]];
    for (std::size_t i = 0; i < u.size(); ++i, row += u.size()) {
      f[i] = 0;
      for (std::size_t j = 0; j < u.size(); ++j) f[i] += row[j] * u[j];
    }
  }

 private:
  std::vector<double> values_;
  std::vector<std::size_t> begin_;  ///< of each element
};

}  // namespace pounding
