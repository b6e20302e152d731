#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "motion/response_spectrum.h"

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

/// Frequency range over which spectra are compared [Hz].
struct FrequencyBand {
  double low = 0;
  double high = 0;
};

/// All frequencies that are compared, and the bands in which errors are listed.
constexpr std::array<FrequencyBand, 5> compared_bands{
    {{1, 400}, {1, 10}, {10, 50}, {50, 150}, {150, 400}}};

/// Distance of a floor spectrum from that of full order, by the natural logarithm of their ratio.
struct ChannelDistance {
  std::string name;  ///< "probe.x"
  /// rms over ln f per band of compared_bands [-]; below 0 where the spectrum has fewer than two
  /// frequencies in it.
  std::array<double, compared_bands.size()> rms{};
  double largest = 0;  ///< |ln ratio| [-]
  double at = 0;       ///< frequency of the largest [Hz]
};

/// Distance between two spectra at the same frequencies.
ChannelDistance spectral_distance(const std::string& name, std::span<const SpectrumPoint> found,
                                  std::span<const SpectrumPoint> reference);

/// Root of the sum of the squares of two rms, below 0 where one is.
double joined(double one, double other);

/// Root of the mean square of the channels' rms in a band, of those that have it; below 0
/// without any.
double rms_of_channels(std::span<const ChannelDistance> channels, std::size_t band);

/// Which spectra count, channels of a probe being three that follow one another: the largest value
/// is above a thousandth of the largest of its probe, and none is round-off beside that.
std::vector<char> moving_channels(std::span<const std::vector<SpectrumPoint>> spectra);

}  // namespace pounding
