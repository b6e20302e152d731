#pragma once

#include <numeric>
#include <span>
#include <string>
#include <vector>

namespace pounding {

/// Columns of `history.h5` beside the motion of probes: their names and datasets, and the columns
/// whose values this rank brings to a record.
struct RecordColumns {
  /// A dataset with a value per column.
  struct Quantity {
    std::string name;
    std::string unit;
  };

  std::string list;                ///< dataset of the names
  std::vector<std::string> names;  ///< of all ranks, the same on all of them
  std::vector<Quantity> quantities;
  std::vector<int> mine;           ///< columns of this rank; of shared ones the values are added
  std::span<const double> values;  ///< of these when a record is made, shape (mine, quantities)

  /// This rank has all columns, with values of shape (columns, quantities).
  void take_all(std::span<const double> all) {
    mine.resize(names.size());
    std::iota(mine.begin(), mine.end(), 0);
    values = all;
  }
};

}  // namespace pounding
