#pragma once

#include <span>

namespace pounding {

/// Largest eigenvalue of M^-1 K for one element: symmetric K, shape (n, n), and diagonal M > 0,
/// shape (n), in K's unit over M's unit. Rows without mass are left out. LAPACK dsyev.
double largest_eigenvalue(std::span<const double> stiffness, std::span<const double> mass);

}  // namespace pounding
