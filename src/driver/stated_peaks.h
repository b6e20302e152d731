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
  std::vector<double> acceleration;  ///< per channel of the recorder, absolute [m/s2]
};

/// The peaks of the records from `spectra.start` on. Rank 0, after Recorder::finish.
StatedPeaks stated_peaks(const Scene& scene, const Recorder& recorder);

/// One line if samples at this interval [s], of steps of so long [s], cannot hold the low-pass that
/// is asked for.
std::vector<std::string> lowered_peak_warnings(const Scene& scene, double interval,
                                               double time_step);

/// One line that names the probes whose sampled peak goes with the output interval. Of runs with
/// impacts: others have no impulse within a sample.
std::vector<std::string> peak_warnings(const Scene& scene, const StatedPeaks& peaks,
                                       const Recorder& recorder);

}  // namespace pounding
