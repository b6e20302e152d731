#pragma once

#include <span>
#include <vector>

namespace pounding {

/// The 75 frequencies [Hz] from 0.2 to 34 Hz at which nuclear practice asks for floor spectra
/// (U.S. NRC Regulatory Guide 1.122, Table 1).
std::vector<double> regulatory_frequencies();

/// The largest value at each frequency; all spectra have the same length.
std::vector<double> envelope_of(std::span<const std::vector<double>> spectra);

/// A spectrum widened by `fraction` to both sides, as Regulatory Guide 1.122 asks for the
/// uncertainty of the structure's frequencies: the value at f is the largest of those from
/// f / (1 + fraction) to f / (1 - fraction), between the given ones linear in log-log (linear where
/// one is zero), none beyond the ends. `frequencies` > 0, increasing; `fraction` in [0, 1). Throws
/// UserError for a fraction out of range.
std::vector<double> broadened(std::span<const double> frequencies, std::span<const double> values,
                              double fraction);

}  // namespace pounding
