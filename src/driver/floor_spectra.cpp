#include "driver/floor_spectra.h"

#include <algorithm>
#include <cstdio>

#include "common/parallel.h"
#include "io/csv_file.h"

namespace pounding {

namespace {

/// The accelerations of the channels that this rank works on: number rank, rank + size, ...; from
/// record `first` on.
std::vector<std::vector<double>> share_accelerations(MPI_Comm comm, std::size_t channels,
                                                     const Recorder& recorder, std::size_t first) {
  const auto counted = [&](std::size_t channel) {
    std::vector<double> acceleration = recorder.acceleration(channel);
    acceleration.erase(
        acceleration.begin(),
        acceleration.begin() + static_cast<std::ptrdiff_t>(std::min(first, acceleration.size())));
    return acceleration;
  };
  const std::size_t ranks = size_of(comm);
  std::vector<std::vector<double>> mine;
  for (std::size_t channel = 0; channel < channels; ++channel) {
    const auto worker = static_cast<int>(channel % ranks);
    if (rank_of(comm) == 0 && worker != 0) {
      send_array(comm, worker, counted(channel));
    } else if (rank_of(comm) == worker) {
      std::vector<double>& acceleration = mine.emplace_back();
      if (worker == 0) {
        acceleration = counted(channel);
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
      for (const double ratio : ratios) {
        // A run is cut, it does not end: the floor still moves, so nothing is said of what follows.
        mine.push_back(response_spectrum(acceleration, recorder.interval(),
                                         scene.spectra.frequencies, ratio, AfterRecord::ignored));
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
      if (channel % ranks == 0) {
        spectrum.points = std::move(mine[channel / ranks * ratios.size() + r]);
      } else {
        receive_array(comm, static_cast<int>(channel % ranks), spectrum.points);
      }
    }
  }
  return spectra;
}

void write_floor_spectra(const std::string& path, const std::vector<ProbeSpectrum>& spectra,
                         double sampling_interval, double start) {
  CsvFile file(path);
  char text[200];
  std::snprintf(text, sizeof text,
                "floor response spectra of absolute acceleration, block means over %.6g s;",
                sampling_interval);
  file.comment(text);
  // Block means lower a spectrum by about (pi f dt)^2 / 2: 1 % at f dt = 0.045.
  std::snprintf(text, sizeof text, "within 1 %% of the continuous signal up to %.0f Hz",
                0.045 / sampling_interval);
  file.comment(text);
  if (start > 0) {
    std::snprintf(text, sizeof text,
                  "of the record from %.9g s on, when the oscillators are at rest;", start);
    file.comment(text);
  }
  file.comment("largest response until the end of the run;");
  file.comment(
      "frequency [Hz], period [s], displacement [m], pseudo_velocity [m/s], "
      "pseudo_acceleration [m/s2]");
  file.header(
      "probe,direction,damping,frequency,period,displacement,pseudo_velocity,"
      "pseudo_acceleration");
  for (const ProbeSpectrum& spectrum : spectra) {
    const std::string label = spectrum.probe + "," + spectrum.direction;
    for (const SpectrumPoint& point : spectrum.points) {
      file.row(label, {spectrum.damping_ratio, point.frequency, 1 / point.frequency,
                       point.displacement, point.pseudo_velocity, point.pseudo_acceleration});
    }
  }
  file.close();
}

}  // namespace pounding
