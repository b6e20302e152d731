#include "driver/stated_peaks.h"

#include <algorithm>
#include <cmath>

#include "driver/facts.h"
#include "driver/stated_peak.h"
#include "motion/low_pass.h"

namespace pounding {
namespace {

/// A sampled peak above so many times the stated one is that of an impulse within a sample.
constexpr double doubtful_ratio = 2;

/// How many times the largest sampled peak of a probe exceeds its largest stated one.
double excess(const StatedPeaks& peaks, const Recorder& recorder, std::size_t probe) {
  double sampled = 0;
  double stated = 0;
  for (std::size_t channel = 3 * probe; channel < 3 * probe + 3; ++channel) {
    sampled = std::max(sampled, recorder.peaks()[channel].acceleration);
    stated = std::max(stated, peaks.acceleration[channel]);
  }
  return stated > 0 ? sampled / stated : 1;
}

}  // namespace

double stated_frequency(const Scene& scene, double interval) {
  return std::min(scene.spectra.peak_frequency, low_pass_limit / interval);
}

double stated_peak(std::span<const double> acceleration, double interval, double frequency,
                   std::size_t first) {
  const std::vector<double> filtered = low_pass(acceleration, interval, frequency);
  double peak = 0;
  for (std::size_t i = first; i < filtered.size(); ++i) {
    peak = std::max(peak, std::abs(filtered[i]));
  }
  return peak;
}

StatedPeaks stated_peaks(const Scene& scene, const Recorder& recorder) {
  StatedPeaks peaks;
  peaks.frequency = stated_frequency(scene, recorder.interval());
  const std::size_t first = recorder.first_record_from(scene.spectra.start);
  for (std::size_t channel = 0; channel < recorder.channels().size(); ++channel) {
    peaks.acceleration.push_back(
        stated_peak(recorder.acceleration(channel), recorder.interval(), peaks.frequency, first));
  }
  return peaks;
}

std::vector<std::string> lowered_peak_warnings(const Scene& scene, double interval,
                                               double time_step) {
  const double frequency = stated_frequency(scene, interval);
  const double needed = low_pass_limit / scene.spectra.peak_frequency;
  if (scene.probes.empty() || !(frequency < scene.spectra.peak_frequency * (1 - 1e-9))) return {};
  return {sentence(
      "peak accelerations are those below {:.4g} Hz, not {:.4g} Hz: samples every {:.4g} s hold no "
      "more; give {}-output_interval {:.4g} or less, or a lower -peak_frequency",
      {frequency, scene.spectra.peak_frequency, interval,
       time_step > needed ? "-time_step and " : "", needed})};
}

std::vector<std::string> peak_warnings(const Scene& scene, const StatedPeaks& peaks,
                                       const Recorder& recorder) {
  constexpr std::size_t named = 3;
  std::vector<std::string> names;
  double most = 1;
  bool reduced = false;
  for (std::size_t p = 0; p < recorder.probes().size(); ++p) {
    const double times = excess(peaks, recorder, p);
    if (!(times > doubtful_ratio)) continue;
    names.push_back(recorder.probes()[p].name);
    most = std::max(most, times);
    reduced = reduced || scene.structures[recorder.probes()[p].structure].modal.has_value();
  }
  if (names.empty()) return {};
  std::string text = names.size() == 1 ? "probe " : "probes ";
  for (std::size_t i = 0; i < std::min(named, names.size()); ++i) {
    text += (i > 0 ? ", " : "") + names[i];
  }
  if (names.size() > named) text += sentence(" and {} more", {names.size() - named});
  return {text +
          sentence(": sampled accelerations reach {:.4g} times the peak below {:.4g} Hz; that "
                   "sampled value goes with 1/output_interval where an impulse acts beside the "
                   "probe{}, so take the other",
                   {most, peaks.frequency, reduced ? " or its structure is reduced" : ""})};
}

}  // namespace pounding
