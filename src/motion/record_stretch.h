#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace pounding::oscillator {

/// Steps of a whole stretch of the record.
inline constexpr std::size_t stretch_size = 64;

/// Samples `first` to `last` of a record, both of which count.
struct Stretch {
  std::size_t first, last;
  double load;      ///< largest |h^2 a|
  double velocity;  ///< largest |h v|, v the velocity that the ground gained since the first sample
  double range;     ///< largest h v less the smallest
};

/// The stretches of a record, whole ones but for the last; each begins where another ends. `h2`:
/// square of the time step [s2].
std::vector<Stretch> stretches_of(std::span<const double> acceleration, double h2);

}  // namespace pounding::oscillator
