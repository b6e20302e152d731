#include "motion/synthetic.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <random>

#include "common/error.h"
#include "common/series.h"
#include "motion/fourier.h"
#include "motion/records/record_text.h"
#include "motion/response_spectrum.h"

namespace pounding {

namespace {

using std::numbers::pi;

constexpr double time_step = synthetic_interval;
constexpr double target_damping = 0.05;
constexpr double highest_matched = 50;  // Hz; a quarter of the sampling frequency
constexpr double points_per_decade = 40;
constexpr int iterations = 40;
constexpr double iteration_gain = 0.7;  // part of the misfit corrected at once
constexpr double accepted_rms = 0.15;   // beyond it the target is out of reach

double smooth_step(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

double time_at(std::size_t i) {
  return static_cast<double>(i) * time_step;
}

std::vector<double> control_frequencies(const TargetSpectrum& target) {
  const double low = target.frequency.front();
  const double high = std::min(highest_matched, target.frequency.back());
  const double intervals = std::ceil(points_per_decade * std::log10(high / low));
  std::vector<double> frequencies;
  for (int i = 0; i <= static_cast<int>(intervals); ++i) {
    frequencies.push_back(low * std::pow(high / low, i / intervals));
  }
  return frequencies;
}

// ln(PSA / target) at the control frequencies, for a peak ground acceleration of 1.
std::vector<double> log_misfit(std::span<const double> acceleration,
                               const std::vector<double>& controls, const TargetSpectrum& target) {
  std::vector<double> misfit;
  for (const auto& point : response_spectrum(acceleration, time_step, controls, target_damping)) {
    misfit.push_back(std::log(point.pseudo_acceleration / target.at(point.frequency)));
  }
  return misfit;
}

// How far a motion is from the target.
struct SpectralMisfit {
  double rms = 0;  // [-]
  double max = 0;  // [-]
};

SpectralMisfit summarise(const std::vector<double>& misfit, double log_scale) {
  SpectralMisfit result;
  for (const double value : misfit) {
    result.rms += (value - log_scale) * (value - log_scale);
    result.max = std::max(result.max, std::abs(value - log_scale));
  }
  result.rms = std::sqrt(result.rms / static_cast<double>(misfit.size()));
  return result;
}

// Quadratic rise, plateau, decay by exp(-3), and the last twentieth down to zero.
double envelope(double t, const SyntheticMotion& motion) {
  const auto [rise_end, decay_start] = motion.envelope;
  double value = 1;
  if (t < rise_end) value = (t / rise_end) * (t / rise_end);
  if (t > decay_start) value = std::exp(-3 * (t - decay_start) / (motion.duration - decay_start));
  return value * smooth_step((motion.duration - t) / (0.05 * motion.duration));
}

// Random phases under the envelope; amplitudes follow the target, fading out an octave below it
// and half an octave above.
std::vector<double> random_motion(const TargetSpectrum& target, const SyntheticMotion& motion,
                                  std::size_t size, double high) {
  const int n = good_fourier_size(static_cast<int>(size));
  const double low = target.frequency.front(), spacing = 1 / (n * time_step);
  std::mt19937_64 generator(static_cast<std::uint64_t>(motion.seed));
  std::vector<std::complex<double>> spectrum(n / 2 + 1);
  for (std::size_t k = 1; k + 1 < spectrum.size(); ++k) {
    const double f = static_cast<double>(k) * spacing;
    const double phase = 2 * pi * static_cast<double>(generator() >> 11) * 0x1p-53;
    const double band = smooth_step(2 * f / low - 1) * smooth_step(3 - 2 * f / high);
    spectrum[k] = std::polar(band * target.at(f) / std::sqrt(f), phase);
  }
  auto acceleration = inverse_fourier(spectrum, n);
  acceleration.resize(size);
  double peak = 0;
  for (std::size_t i = 0; i < size; ++i) {
    acceleration[i] *= envelope(time_at(i), motion);
    peak = std::max(peak, std::abs(acceleration[i]));
  }
  for (double& a : acceleration) a /= peak;
  return acceleration;
}

// Multiplies the Fourier amplitudes by exp(-gain misfit), and removes frequencies well below the
// target's range. Zeros behind the motion keep the filter from wrapping around.
std::vector<double> correct_spectrum(std::vector<double> acceleration,
                                     const std::vector<double>& controls,
                                     const std::vector<double>& misfit) {
  const std::size_t size = acceleration.size();
  const int n = good_fourier_size(2 * static_cast<int>(size));
  acceleration.resize(n);
  auto spectrum = fourier(acceleration);
  const auto last = static_cast<double>(controls.size() - 1);
  const double ratio = std::log(controls.back() / controls.front());
  for (std::size_t k = 0; k < spectrum.size(); ++k) {
    const double f = static_cast<double>(k) / (n * time_step);
    const double x = k == 0 ? 0 : std::log(f / controls.front()) / ratio * last;
    const double place = std::clamp(x, 0.0, last);
    const auto i = std::min(static_cast<std::size_t>(place), controls.size() - 2);
    const double s = place - static_cast<double>(i);
    spectrum[k] *= std::exp(-iteration_gain * ((1 - s) * misfit[i] + s * misfit[i + 1]));
    const double below = 2 * f / controls.front();
    if (below < 1) spectrum[k] *= below * below;
  }
  acceleration = inverse_fourier(spectrum, n);
  acceleration.resize(size);
  return acceleration;
}

// Brings the peak to 1: clips larger values, or else adds a short wavelet of frequency `wavelet`
// [Hz] at the largest value.
void impose_peak(std::vector<double>& acceleration, double wavelet) {
  for (double& a : acceleration) a = std::clamp(a, -1.0, 1.0);
  const auto largest =
      std::max_element(acceleration.begin(), acceleration.end(),
                       [](double a, double b) { return std::abs(a) < std::abs(b); });
  const double missing = std::copysign(1 - std::abs(*largest), *largest);
  const double centre = time_at(static_cast<std::size_t>(largest - acceleration.begin()));
  for (std::size_t i = 0; i < acceleration.size(); ++i) {
    const double x = wavelet * (time_at(i) - centre);
    if (std::abs(x) < 3) {
      acceleration[i] += missing * std::exp(-3.125 * x * x) * std::cos(2 * pi * x);
    }
  }
}

// Fades both ends to zero, then subtracts (c0 + c1 x) sin^2(pi t / T), x in [-1, 1], so that the
// final velocity and displacement, h sum a_i and h sum (T - t_i) a_i, vanish.
void correct_baseline(std::vector<double>& acceleration) {
  const double duration = time_at(acceleration.size() - 1);
  double v = 0, d = 0, v0 = 0, v1 = 0, d0 = 0, d1 = 0;
  const auto window = [&](double t) { return std::pow(std::sin(pi * t / duration), 2); };
  const auto linear = [&](double t) { return 2 * t / duration - 1; };
  for (std::size_t i = 0; i < acceleration.size(); ++i) {
    const double t = time_at(i), rest = duration - t, w = window(t), wx = w * linear(t);
    acceleration[i] *= smooth_step(std::min(t, rest) / (0.02 * duration));
    v += acceleration[i], d += rest * acceleration[i];
    v0 += w, d0 += rest * w, v1 += wx, d1 += rest * wx;
  }
  const double determinant = v0 * d1 - v1 * d0;
  const double c0 = (v * d1 - v1 * d) / determinant, c1 = (v0 * d - v * d0) / determinant;
  for (std::size_t i = 0; i < acceleration.size(); ++i) {
    acceleration[i] -= (c0 + c1 * linear(time_at(i))) * window(time_at(i));
  }
  acceleration.front() = acceleration.back() = 0;
}

double peak_of(const std::vector<double>& acceleration) {
  return Accelerogram{acceleration, time_step}.peak();
}

}  // namespace

double TargetSpectrum::at(double f) const {
  return log_interpolated(frequency, ratio, f);
}

TargetSpectrum read_target_spectrum(const std::string& file, const std::string& values) {
  TargetSpectrum target;
  bool names_allowed = true;
  std::vector<TextLine> lines = read_text_lines(file);
  replace_decimal_commas(file, 1, lines);
  for (const auto& line : lines) {
    if (line.text.empty() || is_comment(line.text)) continue;
    const auto row = parse_row(line);
    if (!row && names_allowed && !parse_number(split_words(line.text)[0])) {
      names_allowed = false;
      continue;
    }
    names_allowed = false;
    refuse_if(!row || row->values.size() != 2 || !(row->values[0] > 0) || !(row->values[1] > 0),
              at_line(file, line.number) + "'" + line.text.substr(0, 60) +
                  "' is not a frequency [Hz] and " + values + ", both positive");
    target.frequency.push_back(row->values[0]);
    target.ratio.push_back(row->values[1]);
  }
  const std::size_t size = target.frequency.size();
  if (size < 2) throw UserError(file + ": a spectrum needs at least 2 lines of numbers");
  if (target.frequency[1] < target.frequency[0]) {
    std::reverse(target.frequency.begin(), target.frequency.end());
    std::reverse(target.ratio.begin(), target.ratio.end());
  }
  for (std::size_t i = 1; i < size; ++i) {
    refuse_if(!(target.frequency[i] > target.frequency[i - 1]),
              file + ": frequency " + std::to_string(target.frequency[i]) +
                  " Hz is out of order; sort the lines by frequency, each once");
  }
  return target;
}

void check_synthetic(const TargetSpectrum& target, const SyntheticMotion& motion, double pga) {
  const auto refuse_if = [](bool wrong, const std::string& what) {
    pounding::refuse_if(wrong, "synthetic motion: " + what);
  };
  const auto [rise_end, decay_start] = motion.envelope;
  refuse_if(target.frequency.size() < 2, "the target spectrum needs at least 2 frequencies");
  refuse_if(!(target.frequency.front() < highest_matched),
            "the target spectrum must begin below " + std::to_string(highest_matched) + " Hz");
  refuse_if(!(std::isfinite(pga) && pga > 0),
            "pga " + std::to_string(pga) + " must be positive [m/s2]");
  refuse_if(!(motion.duration >= 2 / target.frequency.front() && motion.duration <= 1000),
            "duration " + std::to_string(motion.duration) +
                " s must hold two periods of the lowest target frequency and not exceed 1000 s");
  refuse_if(!(rise_end >= 0 && rise_end <= decay_start && decay_start <= motion.duration),
            "envelope " + std::to_string(rise_end) + "," + std::to_string(decay_start) +
                " must be 0 <= end of rise <= start of decay <= duration [s]");
}

Accelerogram generate_accelerogram(const TargetSpectrum& target, const SyntheticMotion& motion,
                                   double pga) {
  check_synthetic(target, motion, pga);
  const auto size = static_cast<std::size_t>(std::llround(motion.duration / time_step)) + 1;
  const auto controls = control_frequencies(target);
  // The wavelet belongs to the upper end of the target's plateau.
  const double top = *std::max_element(target.ratio.begin(), target.ratio.end());
  double wavelet = controls.back();
  for (const double f : controls) {
    if (target.at(f) >= 0.95 * top) wavelet = f;
  }

  auto current = random_motion(target, motion, size, controls.back());
  std::vector<double> best;
  double best_score = std::numeric_limits<double>::infinity(), best_rms = 10;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    impose_peak(current, wavelet);
    correct_baseline(current);
    const auto misfit = log_misfit(current, controls, target);
    const auto seen = summarise(misfit, std::log(peak_of(current)));
    const double score = std::max(seen.rms, seen.max / 3);
    if (score < best_score) best = current, best_score = score, best_rms = seen.rms;
    current = correct_spectrum(std::move(current), controls, misfit);
  }
  refuse_if(!(best_rms < accepted_rms), "synthetic motion: the 5 % spectrum stays " +
                                            std::to_string(std::lround(100 * best_rms)) +
                                            " % rms from " + motion.target +
                                            "; lengthen the duration or smooth the target");
  const double scale = pga / peak_of(best);
  for (double& a : best) {
    a *= scale;
    if (std::abs(std::abs(a) / pga - 1) < 1e-14) a = std::copysign(pga, a);
  }
  return {std::move(best), time_step};
}

}  // namespace pounding
