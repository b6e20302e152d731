#pragma once

#include <vector>

#include "dynamics/state.h"
#include "dynamics/update.h"
#include "system/linear_system.h"

namespace pounding {

/// How fast a structure in generalised coordinates can close gaps, coordinate by coordinate: none
/// of them moves another, so each is bounded by its own energy. Per coordinate, with mass m,
/// damping c and stiffness k, and ubar the mean of two displacements one step apart,
///
///     a v^2 + k ubar^2,      a = m - dt/2 c - dt^2/4 k
///
/// falls but for the ground: |v| <= r = sqrt(v^2 + k ubar^2 / a), which rises per step by at most
/// dt m |iota| |a_g| / a (energy identity of dynamics/energy_balance.h). A gap then changes no
/// faster than sum_k |L_k| r_k. Uniform damping stiffens k in `a`, softens that of ubar, and adds
/// its branches, s a_i k (ubar - y_i)^2, see docs/theory/damping.md. About a rest u_0 that it
/// leaves alone, ubar - u_0 replaces ubar and the weight less k u_0 for the weight. Local.
class CoordinateRates {
 public:
  /// `rows`: L T over the owned coordinates, shape (gaps, coordinates). `ground_acceleration`:
  /// largest norm of it, gravity apart [m/s2]. The step must be stable, so that every `a` is
  /// positive. Collective over the system's communicator.
  CoordinateRates(const LinearSystem& system, std::vector<double> rows, double ground_acceleration,
                  double time_step);

  /// Bound of all gap rates at the last step made, before any contact [m/s].
  double rate(const StructureState& state);
  /// Largest rise of that bound per step [m/s].
  double growth() const { return growth_; }

 private:
  double largest(const std::vector<double>& speeds);

  double time_step_;
  std::vector<double> rest_;              ///< u_0 where uniform damping acts about it, or zero [m]
  std::vector<double> stiffness_over_a_;  ///< k / a, softened [1/s2]
  /// Stiffness of each branch over the coordinates, s a_i k / a [1/s2], and 1 / k [m/N].
  std::vector<std::vector<double>> branch_over_a_;
  Filters<double> filters_;
  std::vector<double> compliance_;
  std::vector<double> rows_;    ///< |L T|
  std::vector<double> speeds_;  ///< r
  std::vector<double> rates_;   ///< per gap
  double growth_ = 0;
};

}  // namespace pounding
