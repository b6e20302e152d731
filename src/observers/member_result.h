#pragma once

#include <vector>

namespace pounding {

/// Numbers of one member of an ensemble, as ensemble.h5 holds them.
struct MemberResult {
  std::vector<double> spectra;      ///< PSA, shape (channels, damping ratios, frequencies) [m/s2]
  std::vector<double> episodes;     ///< per contact, as the next ones
  std::vector<double> first_time;   ///< [s]; not a number without an impact
  std::vector<double> impulse_sum;  ///< [N s]
  std::vector<double> impulse_largest;    ///< of an episode [N s]
  std::vector<double> force_peak;         ///< [N]
  std::vector<double> smallest_gap;       ///< [m]
  std::vector<double> slip;               ///< sum over the episodes of a contact with friction [m]
  std::vector<double> struck;             ///< see StruckAreas, shape (contacts, windows, 5)
  std::vector<double> pair_initial_gap;   ///< per pair of the contacts, as the next ones [m]
  std::vector<double> pair_least_gap;     ///< of the samples [m]
  std::vector<double> pair_time;          ///< of that [s]
  std::vector<double> pair_displacement;  ///< see PairMotion, shape (pairs, 3) [m]
  std::vector<double> other_depth;        ///< see OtherPass [m]
  std::vector<double> other_row;          ///< of the rows that are only looked at
  std::vector<double> other_time;         ///< [s]
  std::vector<double> displacement;       ///< largest per channel [m]
  std::vector<double> acceleration;       ///< largest per channel after the low-pass [m/s2]
  std::vector<double> span_peak;          ///< see SpanPeaks, shape (spans, 8) [m, rad]
  std::vector<double> span_time;          ///< of these [s]
  std::vector<double> settled;            ///< see fill_bases, shape (bases, 3) [m]
  std::vector<double> forces;             ///< shape (records, columns) [N, N m]
  std::vector<double> energy_residual;    ///< one number: largest, relative
  std::vector<double> contact_residual;   ///< one number: of complementarity, largest [-]
};

}  // namespace pounding
