#pragma once

#include <vector>

#include "soil/impedance.h"
#include "soil/impedance_table.h"

namespace pounding {

/// Motions of a mat that the table couples, and the fit to their block of it. Terms are
/// taken over the root of the product of the moduli of the two diagonals, frequency by frequency.
struct BlockFit {
  std::array<bool, 6> motions{};
  int cells = 0;             ///< internal parts with rates of their own
  double largest = 0;        ///< misfit of a term, the largest [-]
  double largest_at = 0;     ///< its frequency [Hz]
  double mean = 0;           ///< misfit of a term, the mean over the frequencies [-]
  double table_damping = 0;  ///< least eigenvalue of the imaginary part of the table [-]
  double damping = 0;        ///< the same of the fit, from the first frequency to the last [-]
  double damping_at = 0;     ///< its frequency [Hz]
  double margin = 0;         ///< least eigenvalue of the real part of impedance over i omega at
                             ///< any frequency, over the median of the largest in the table [-]
  double margin_at = 0;      ///< its frequency [Hz]
};

/// Springs, dashpots and masses that have the impedances of a table.
struct ImpedanceFit {
  std::array<double, 2> band{};          ///< first and last frequency of the table [Hz]
  std::vector<DirectedImpedance> parts;  ///< they act side by side
  std::vector<BlockFit> blocks;
  double left_out = 0;  ///< largest term between motions of different blocks, as in BlockFit [-]

  /// Impedance of all parts.
  ImpedanceMatrix at(double circular_frequency) const;
};

/// Parts whose impedance S misses that of a table least, relative to it:
///
///     S = K + i omega C - omega^2 M + sum_j X_j i omega / (1 + i omega / p_j + q_j / (i omega))
///
/// with symmetric K, C, M and X_j that have no negative eigenvalue, and p_j > 0, q_j >= 0: the j-th
/// term is a dashpot X_j, a spring X_j p_j and a mass X_j / q_j in series, of which spring or mass
/// may be missing. Each of them can only take energy, so S over i omega is positive real, whatever
/// the table is. For given rates p_j, q_j the rest is a convex problem, which is solved; rates are
/// added one pair at a time, at the best of a grid, and moved while the misfit falls, so that
/// nothing here can fail to end. Motions are coupled where the table couples them by more than a
/// thousandth of their diagonals. Of a first frequency f > 0 the table is continued to 0 by a
/// parabola.
ImpedanceFit fit_impedances(const ImpedanceTable& table);

}  // namespace pounding
