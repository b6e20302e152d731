#pragma once

#include <map>

#include <mpi.h>

namespace pounding::stiffness {

/// Values that differ by round-off become one, the same on every rank and for any number of ranks.
class CommonValues {
 public:
  /// Values no farther than `tolerance` > 0 from another one belong together.
  explicit CommonValues(double tolerance) : tolerance_(tolerance) {}

  void add(double value);
  /// Puts the values of all ranks together. Collective.
  void agree(MPI_Comm comm);
  /// Value that one that was added stands for after `agree`: the middle of those that belong
  /// together. Where there are too many different ones to compare, a multiple of the tolerance.
  double operator()(double value) const;

 private:
  void add_range(double low, double high);

  double tolerance_;
  std::map<double, double> ranges_;  ///< from the lowest to the highest value that belong together
  bool too_many_ = false;
};

}  // namespace pounding::stiffness
