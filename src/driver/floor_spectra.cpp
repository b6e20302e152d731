#include "driver/floor_spectra.h"

#include <cstdio>

#include "output/csv_file.h"

namespace pounding {

std::vector<ProbeSpectrum> compute_floor_spectra(const Scene& scene, const Recorder& recorder) {
  std::vector<ProbeSpectrum> spectra;
  for (std::size_t channel = 0; channel < recorder.channels().size(); ++channel) {
    const std::vector<double> acceleration = recorder.acceleration(channel);
    for (const double ratio : scene.spectra.damping_ratios) {
      // A run is cut, it does not end: the floor still moves, so nothing is said of what follows.
      spectra.push_back(
          {recorder.probes()[channel / 3].name, direction_names[channel % 3], ratio,
           response_spectrum(acceleration, recorder.interval(), scene.spectra.frequencies, ratio,
                             AfterRecord::ignored)});
    }
  }
  return spectra;
}

void write_floor_spectra(const std::string& path, const std::vector<ProbeSpectrum>& spectra,
                         double sampling_interval) {
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
