#pragma once

#include <vector>

#include "scene/option_row.h"

namespace pounding {

/// Damping filter of first order, a Maxwell branch beside the springs of K: it carries K (u - y),
/// with dy/dt = rate (u - y).
struct DampingFilter {
  double weight = 0;  ///< a_i, stiffness of the branch over that of K [-]
  double rate = 0;    ///< omega_i [rad/s]
};

/// Uniform damping over a band: one damping ratio for every motion between two frequencies. K acts
/// through filters, in Laplace's variable z
///
///     s G(z) K,      G(z) = 1 + sum_i a_i z / (omega_i + z)      (of a rest K itself)
///
/// so that a mode omega_0 of K swings freely as exp(z t) with z^2 = -omega_0^2 s G(z), at the
/// frequency |z| and the damping ratio -Re z / |z|. The largest deviation of that ratio over the
/// band is as small as the number of filters allows. Causality makes fast motions stiffer than slow
/// ones: s = 1 / |G| at one frequency, where modes keep their place. Sources:
/// docs/reference/theory/damping.md.
struct UniformDamping {
  double ratio = 0;      ///< xi [-]
  double lowest = 1;     ///< lower end of the band [Hz]
  double highest = 400;  ///< its upper end [Hz]
  /// Where modes keep their frequency [Hz]; 0 as long as it is not known: then s = 1, its bound.
  double reference = 0;
  std::vector<DampingFilter> filters;
  double ripple = 0;  ///< largest deviation from `ratio` over the band, relative [-]

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option("<structure>_damping_uniform", real("-", absent("optional"), closed(0, 0.3)), "instead of alpha and beta: one damping ratio for every frequency of a band, which hardly shortens the step");
    option("<structure>_damping_band", reals("Hz", "1,400", "two numbers f1,f2", positive), "uniform damping: the band");
    option("<structure>_damping_filters", integer("-", "3", closed(1, 8)), "uniform damping: number of filters that make it; more hold the ratio more closely, or over a wider band");
    option(&UniformDamping::reference, "<structure>_damping_reference", real("Hz", absent("left out: the first mode"), positive), "uniform damping: frequency at which the stiffness is that of the materials; slower motions find less, faster ones more");
    // clang-format on
  }

  /// s: factor of K for the slowest motions [-].
  double at_rest() const;
  /// s (1 + sum a_i): factor of K for the fastest motions, which limit the step [-].
  double at_once() const;
  /// Damping ratio -Re z / |z| of free motions with |z| = omega [rad/s].
  double ratio_at(double omega) const;
  /// Frequency |z| at which a mode moves that K alone lets move at `frequency`: both in Hz.
  double moved(double frequency) const;
};

/// Filters for a damping ratio in [0, 0.3] between two frequencies [Hz], lowest < highest: the
/// equal ripple of Chebyshev, by Remez' exchange from a fit in the mean. No filters where the
/// ratio is 0.
UniformDamping fit_uniform_damping(double ratio, double lowest, double highest, int filters);

}  // namespace pounding
