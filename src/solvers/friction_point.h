#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "solvers/sparse_rows.h"

/// Coulomb's law at one point, whose mobility is its own block of H.
namespace pounding::interactions {

/// Two components along a face.
using Tangents = std::array<double, 2>;

inline double size(double x, double y) {
  return std::sqrt(x * x + y * y);
}

/// Tangential impulse x [N s] of one point of Coulomb's law at a known normal impulse: the least of
/// 1/2 x^T A x + c^T x on the disk |x| <= radius, A = {a11, a12, a22} symmetric semi-definite
/// [1/kg]. Directions without mobility get no impulse. In closed form within the disk, by Newton's
/// iteration on the secular equation on its edge (More and Sorensen, SIAM J. Sci. Stat. Comput. 4
/// (1983) 553).
void solve_on_disk(const double (&matrix)[3], const double (&rate)[2], double radius,
                   double (&impulse)[2]);

/// One point of a frictional contact problem by itself, normal first and then two tangents.
class FrictionPoint {
 public:
  FrictionPoint(const SparseRows& delassus, std::size_t number);

  double h(std::size_t a, std::size_t b) const { return block_[3 * a + b]; }  ///< [1/kg]
  double normal() const { return h(0, 0); }
  double tangential() const { return (h(1, 1) + h(2, 2)) / 2; }
  /// Whether its normal and its tangents do not feel each other.
  bool uncoupled() const;
  /// Tangential impulse [N s] where the rate without it is `rate` [m/s].
  Tangents slide(const Tangents& rate, double radius) const;
  /// How far rates [m/s] and impulses [N s] are from the law [m/s]; see friction_residual.
  double natural_map(double coefficient, const double* rate, const double* impulse) const;

  std::size_t first;  ///< of its three rows

 private:
  bool isotropic() const;

  std::array<double, 9> block_{};
};

}  // namespace pounding::interactions
