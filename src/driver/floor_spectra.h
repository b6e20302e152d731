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

/// Spectra of every recorded channel, on rank 0, after the recorder finished; the channels are
/// shared out among the ranks. Collective.
std::vector<ProbeSpectrum> compute_floor_spectra(MPI_Comm comm, const Scene& scene,
                                                 const Recorder& recorder);

/// `spectra.csv`; the header states the sampling, up to which frequency it holds, and the start [s]
/// of what counts unless it is 0.
void write_floor_spectra(const std::string& path, const std::vector<ProbeSpectrum>& spectra,
                         double sampling_interval, double start);

}  // namespace pounding
