#pragma once

#include <array>
#include <complex>
#include <vector>

namespace pounding {

/// Symmetric matrix of the forces and moments on a mat, along and about x, y, z, over its motions
/// exp(i omega t): shape (6, 6), row-major [N/m, N, N m].
using ImpedanceMatrix = std::array<std::complex<double>, 36>;

/// Impedance of a mat at some frequencies.
struct ImpedanceTable {
  std::vector<double> frequency;  ///< increasing, the first not below 0 [Hz]
  std::vector<ImpedanceMatrix> impedance;
};

}  // namespace pounding
