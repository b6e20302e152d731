#pragma once

#include <string>
#include <vector>

#include "output/recorder.h"
#include "scene/scene.h"

namespace pounding {

/// Peaks of acceleration that depend neither on the time step nor on the output interval: largest
/// magnitudes of the recorded accelerations after a low-pass without phase (low_pass.h).
struct StatedPeaks {
  double frequency = 0;              ///< of the low-pass [Hz]
  bool lowered = false;              ///< from what was asked to what the interval can hold
  std::vector<double> acceleration;  ///< per channel of the recorder, absolute [m/s2]
};

/// The peaks of the records from `spectra.start` on. Rank 0, after Recorder::finish.
StatedPeaks stated_peaks(const Scene& scene, const Recorder& recorder);

/// One line if the low-pass had to be lowered, and one that names the probes whose sampled peak
/// goes with the output interval. Of runs with impacts: others have no impulse within a sample.
std::vector<std::string> peak_warnings(const Scene& scene, const StatedPeaks& peaks,
                                       const Recorder& recorder);

}  // namespace pounding
