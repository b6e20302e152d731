#pragma once

#include <string>
#include <vector>

#include "motion/response_spectrum.h"
#include "output/recorder.h"
#include "scene/scene.h"

namespace pounding {

/// Floor response spectrum of one probe, direction and damping ratio.
struct ProbeSpectrum {
  std::string probe;
  std::string direction;
  double damping_ratio = 0;
  std::vector<SpectrumPoint> points;
};

/// Spectra of every recorded channel (rank 0 only, after the recorder finished).
std::vector<ProbeSpectrum> compute_floor_spectra(const Scene& scene, const Recorder& recorder);

/// `spectra.csv`; the header states the sampling and up to which frequency it holds.
void write_floor_spectra(const std::string& path, const std::vector<ProbeSpectrum>& spectra,
                         double sampling_interval);

}  // namespace pounding
