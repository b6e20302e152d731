#include "motion/spectrum_shape.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "common/series.h"

namespace pounding {
namespace {

/// Largest value of a spectrum of a channel that counts, relative to the largest of its probe.
constexpr double moving_part = 1e-3;

/// Values below this part of the largest of the probe are round-off.
constexpr double roundoff_part = 1e-9;

/// rms of values over ln f by the trapezoidal rule; below 0 for fewer than two frequencies.
double rms_over(std::span<const double> frequency, std::span<const double> ratio,
                const FrequencyBand& band) {
  double length = 0;
  double sum = 0;
  for (std::size_t i = 0; i + 1 < frequency.size(); ++i) {
    if (frequency[i] < band.low * (1 - 1e-9) || frequency[i + 1] > band.high * (1 + 1e-9)) continue;
    const double step = std::log(frequency[i + 1] / frequency[i]);
    length += step;
    sum += step * (ratio[i] * ratio[i] + ratio[i + 1] * ratio[i + 1]) / 2;
  }
  return length > 0 ? std::sqrt(sum / length) : -1;
}

}  // namespace

std::vector<double> regulatory_frequencies() {
  struct Range {
    int end;   // [0.01 Hz]
    int step;  // [0.01 Hz]
  };
  constexpr Range ranges[] = {{300, 10},  {360, 15},   {500, 20},   {800, 25},
                              {1500, 50}, {1800, 100}, {2200, 200}, {3400, 300}};
  std::vector<double> frequencies;
  int f = 20;
  for (const Range& range : ranges) {
    for (; f < range.end; f += range.step) frequencies.push_back(f / 100.0);
  }
  frequencies.push_back(f / 100.0);
  return frequencies;
}

std::vector<double> envelope_of(std::span<const std::vector<double>> spectra) {
  std::vector<double> envelope = spectra.front();
  for (const auto& spectrum : spectra) {
    std::ranges::transform(envelope, spectrum, envelope.begin(),
                           [](double a, double b) { return std::max(a, b); });
  }
  return envelope;
}

std::vector<double> broadened(std::span<const double> frequencies, std::span<const double> values,
                              double fraction) {
  refuse_if(!(fraction >= 0 && fraction < 1),
            "broadening must be in [0, 1), not " + std::to_string(fraction));
  std::vector<double> result(values.begin(), values.end());
  if (fraction == 0) return result;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double low = frequencies[i] / (1 + fraction), high = frequencies[i] / (1 - fraction);
    result[i] = std::max(log_interpolated(frequencies, values, low),
                         log_interpolated(frequencies, values, high));
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (frequencies[k] >= low && frequencies[k] <= high) {
        result[i] = std::max(result[i], values[k]);
      }
    }
  }
  return result;
}

ChannelDistance spectral_distance(const std::string& name, std::span<const SpectrumPoint> found,
                                  std::span<const SpectrumPoint> reference) {
  std::vector<double> frequency;
  std::vector<double> ratio;
  ChannelDistance distance{name};
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double f = found[i].frequency;
    if (f < compared_bands[0].low * (1 - 1e-9) || f > compared_bands[0].high * (1 + 1e-9)) continue;
    frequency.push_back(f);
    ratio.push_back(std::log(found[i].pseudo_acceleration / reference[i].pseudo_acceleration));
    if (std::abs(ratio.back()) > distance.largest) {
      distance.largest = std::abs(ratio.back());
      distance.at = f;
    }
  }
  for (std::size_t b = 0; b < compared_bands.size(); ++b) {
    distance.rms[b] = rms_over(frequency, ratio, compared_bands[b]);
  }
  return distance;
}

double joined(double one, double other) {
  return one < 0 || other < 0 ? -1 : std::hypot(one, other);
}

double rms_of_channels(std::span<const ChannelDistance> channels, std::size_t band) {
  double sum = 0;
  int count = 0;
  for (const ChannelDistance& channel : channels) {
    if (channel.rms[band] < 0) continue;
    sum += channel.rms[band] * channel.rms[band];
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : -1;
}

std::vector<char> moving_channels(std::span<const std::vector<SpectrumPoint>> spectra) {
  std::vector<double> largest;
  std::vector<double> smallest;
  for (const std::vector<SpectrumPoint>& points : spectra) {
    const auto [low, high] = std::ranges::minmax_element(
        points, {}, [](const SpectrumPoint& point) { return point.pseudo_acceleration; });
    smallest.push_back(low->pseudo_acceleration);
    largest.push_back(high->pseudo_acceleration);
  }
  std::vector<char> moving;
  for (std::size_t c = 0; c < spectra.size(); ++c) {
    const std::size_t first = c - c % 3;
    const double probe =
        *std::max_element(largest.begin() + static_cast<std::ptrdiff_t>(first),
                          largest.begin() + static_cast<std::ptrdiff_t>(first + 3));
    moving.push_back(largest[c] > moving_part * probe && smallest[c] > roundoff_part * probe ? 1
                                                                                             : 0);
  }
  return moving;
}

}  // namespace pounding
