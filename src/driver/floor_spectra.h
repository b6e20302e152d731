#pragma once

#include <span>
#include <string>
#include <vector>

#include "motion/ground_motion.h"
#include "motion/response_spectrum.h"
#include "output/recorder.h"
#include "scene/scene.h"

namespace pounding {

/// Response spectrum of one probe or of the ground, in one direction, at one damping ratio.
struct ProbeSpectrum {
  std::string probe;  ///< or `ground_name`
  std::string direction;
  double damping_ratio = 0;
  double interval = 0;     ///< between the samples that it was made of [s]
  double valid_up_to = 0;  ///< frequency up to which the samples hold it [Hz]
  std::vector<SpectrumPoint> points;
};

/// Stands for a probe in the rows of the ground; a probe of that name takes their place.
inline constexpr const char* ground_name = "ground";

/// Spectra of every recorded channel, on rank 0, after the recorder finished; the channels are
/// shared out among the ranks. Collective.
std::vector<ProbeSpectrum> compute_floor_spectra(MPI_Comm comm, const Scene& scene,
                                                 const Recorder& recorder);

/// Spectra of the ground's motion in the directions that have one, from `spectra.start` until the
/// end of the run: exact for the record as it is applied, linear between its samples. Empty where
/// the ground itself rests (a motion from below) and where a probe is called `ground_name`.
std::vector<ProbeSpectrum> compute_ground_spectra(const Scene& scene, const GroundMotion& motion);

/// `spectra.csv`, in the columns of `spectrum_columns` (io/spectra_table.h); `start` [s]: of what
/// counts; `digits`: significant ones. Throws UserError if it cannot be written.
void write_floor_spectra(const std::string& path, std::span<const ProbeSpectrum> spectra,
                         double start, int digits);

}  // namespace pounding
