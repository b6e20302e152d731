#include "driver/floor_spectra.h"

#include <algorithm>
#include <cmath>

#include "common/parallel.h"
#include "io/csv_file.h"
#include "io/spectra_table.h"

namespace pounding {

namespace {

/// The accelerations of the channels that this rank works on: number rank, rank + size, ...; from
/// record `first` on.
std::vector<std::vector<double>> share_accelerations(MPI_Comm comm, std::size_t channels,
                                                     const Recorder& recorder, std::size_t first) {
  const std::size_t ranks = size_of(comm);
  std::vector<std::vector<double>> mine;
  for (std::size_t channel = 0; channel < channels; ++channel) {
    const auto worker = static_cast<int>(channel % ranks);
    if (rank_of(comm) == 0 && worker != 0) {
      send_array(comm, worker, recorder.acceleration(channel, first));
    } else if (rank_of(comm) == worker) {
      std::vector<double>& acceleration = mine.emplace_back();
      if (worker == 0) {
        acceleration = recorder.acceleration(channel, first);
      } else {
        receive_array(comm, 0, acceleration);
      }
    }
  }
  return mine;
}

}  // namespace

std::vector<ProbeSpectrum> compute_floor_spectra(MPI_Comm comm, const Scene& scene,
                                                 const Recorder& recorder) {
  const std::size_t channels = 3 * recorder.probes().size();
  const std::vector<double>& ratios = scene.spectra.damping_ratios;
  const auto accelerations = share_accelerations(comm, channels, recorder,
                                                 recorder.first_record_from(scene.spectra.start));
  std::vector<std::vector<SpectrumPoint>> mine;  // per channel and damping ratio
  on_every_rank(comm, [&] {
    for (const std::vector<double>& acceleration : accelerations) {
      // A run is cut, it does not end: the floor still moves, so nothing is said of its motion
      // afterwards.
      for (auto& spectrum :
           response_spectra(acceleration, recorder.interval(), scene.spectra.frequencies, ratios,
                            AfterRecord::ignored)) {
        mine.push_back(std::move(spectrum));
      }
    }
  });
  if (rank_of(comm) != 0) {
    for (const std::vector<SpectrumPoint>& points : mine) send_array(comm, 0, points);
    return {};
  }
  const std::size_t ranks = size_of(comm);
  std::vector<ProbeSpectrum> spectra;
  for (std::size_t channel = 0; channel < channels; ++channel) {
    for (std::size_t r = 0; r < ratios.size(); ++r) {
      ProbeSpectrum& spectrum = spectra.emplace_back();
      spectrum.probe = recorder.probes()[channel / 3].name;
      spectrum.direction = direction_names[channel % 3];
      spectrum.damping_ratio = ratios[r];
      spectrum.interval = recorder.interval();
      spectrum.valid_up_to = faithful_up_to(recorder.interval());
      if (channel % ranks == 0) {
        spectrum.points = std::move(mine[channel / ranks * ratios.size() + r]);
      } else {
        receive_array(comm, static_cast<int>(channel % ranks), spectrum.points);
      }
    }
  }
  return spectra;
}

std::vector<ProbeSpectrum> compute_ground_spectra(const Scene& scene, const GroundMotion& motion) {
  std::vector<ProbeSpectrum> spectra;
  if (std::ranges::find(scene.probes, ground_name, &Probe::name) != scene.probes.end()) return {};
  for (std::size_t d = 0; d < 3; ++d) {
    if (!motion.active(static_cast<int>(d))) continue;
    const double step = motion.component(static_cast<int>(d)).time_step;
    std::vector<double> samples;
    const auto last = static_cast<std::int64_t>(scene.end_time / step + 1e-6);
    auto k = static_cast<std::int64_t>(std::ceil(scene.spectra.start / step - 1e-6));
    for (; k <= last; ++k) {
      samples.push_back(motion.acceleration(static_cast<int>(d), static_cast<double>(k) * step));
    }
    if (samples.size() < 2) continue;
    const std::vector<double>& ratios = scene.spectra.damping_ratios;
    auto points =
        response_spectra(samples, step, scene.spectra.frequencies, ratios, AfterRecord::ignored);
    for (std::size_t r = 0; r < ratios.size(); ++r) {
      spectra.push_back(
          {ground_name, direction_names[d], ratios[r], step, 0.5 / step, std::move(points[r])});
    }
  }
  return spectra;
}

void write_floor_spectra(const std::string& path, std::span<const ProbeSpectrum> spectra,
                         double start, int digits) {
  CsvFile file(path, digits);
  file.header(spectrum_columns);
  for (const ProbeSpectrum& spectrum : spectra) {
    const std::string label = spectrum.probe + "," + spectrum.direction + ",complete";
    for (const SpectrumPoint& point : spectrum.points) {
      file.row(label, {spectrum.damping_ratio, point.frequency, 1 / point.frequency,
                       point.displacement, point.pseudo_velocity, point.pseudo_acceleration,
                       spectrum.interval, spectrum.valid_up_to, start, 0});
    }
  }
  file.close();
}

}  // namespace pounding
