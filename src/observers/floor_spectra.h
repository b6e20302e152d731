#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/facts.h"
#include "motion/ground_motion.h"
#include "motion/response_spectrum.h"
#include "motion/synthetic.h"
#include "observers/recorder.h"
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

/// `spectra.csv`, in the columns of `spectrum_columns` (io/csv_file.h). Throws UserError if it
/// cannot be written.
void write_floor_spectra(const Scene& scene, std::span<const ProbeSpectrum> spectra);
/// Capacities of the scene's equipment, in its order [m/s2]. Throws UserError: a file that is no
/// spectrum, a band that the capacity or the floor spectra do not have. Serial.
std::vector<TargetSpectrum> read_capacities(const Scene& scene);

/// Increasing frequencies of floor spectra with those of the capacities that lie between the first
/// and the last of them: a capacity has its corners there.
std::vector<double> with_capacities(std::vector<double> frequencies,
                                    std::span<const TargetSpectrum> capacities);

/// Spectra of items in a cabinet, an oscillator on the floor: those of the cabinet's absolute
/// acceleration at the damping ratio and in the directions of the item, with `<item> cabinet` in
/// place of a probe. `floors`: spectra of the probes. Rank 0, after the recorder finished.
std::vector<ProbeSpectrum> cabinet_spectra(const Scene& scene, const Recorder& recorder,
                                           std::span<const ProbeSpectrum> floors);

/// Places and capacities of the items, and the rules that python/pounding judges them by.
Facts equipment_facts(const Scene& scene, std::span<const TargetSpectrum> capacities);

/// Peaks of acceleration that depend neither on the time step nor on the output interval: largest
/// magnitudes of the recorded accelerations after a low-pass without phase (signal_treatment.h).
struct StatedPeaks {
  double frequency = 0;              ///< of the low-pass [Hz]
  std::vector<double> acceleration;  ///< per channel of the recorder, absolute [m/s2]
};

/// The peaks of the records from `spectra.start` on. Rank 0, after Recorder::finish.
StatedPeaks stated_peaks(const Scene& scene, const Recorder& recorder);

/// The frequency [Hz] of the low-pass before stated peaks of records at this interval [s]: what was
/// asked, or the highest that they can hold.
double stated_frequency(const Scene& scene, double interval);

/// Largest magnitude of an acceleration after that low-pass, from record `first` on.
double stated_peak(std::span<const double> acceleration, double interval, double frequency,
                   std::size_t first);

}  // namespace pounding
