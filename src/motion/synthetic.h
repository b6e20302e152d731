#pragma once

#include <string>
#include <vector>

#include "motion/accelerogram.h"
#include "scene/scene.h"

namespace pounding {

/// Target response spectrum at 5 % damping, as a shape.
struct TargetSpectrum {
  std::vector<double> frequency;  ///< increasing [Hz]
  std::vector<double> ratio;      ///< pseudo-acceleration / PGA [-]

  /// Ratio at a frequency: linear in log-log, constant beyond the ends.
  double at(double frequency_hz) const;
};

/// Reads a target spectrum: lines of frequency [Hz], PSA / PGA; frequencies increase or decrease; #
/// opens a comment; a line of names may come first. `values`: name of the second column in
/// messages. Throws UserError (file, line, remedy).
TargetSpectrum read_target_spectrum(const std::string& file,
                                    const std::string& values = "a ratio PSA / PGA");

/// Between the samples of a synthetic accelerogram [s].
inline constexpr double synthetic_interval = 0.005;

/// Throws UserError for the inputs that generate_accelerogram() refuses before it begins.
void check_synthetic(const TargetSpectrum& target, const SyntheticMotion& motion, double pga);

/// A synthetic accelerogram whose 5 % spectrum follows the target, sampled every 0.005 s: random
/// phases under an envelope (quadratic rise, plateau, exponential decay), then iterations that
/// multiply the Fourier amplitudes by target / spectrum (Gasparini and Vanmarcke, MIT R76-4, 1976);
/// the best of 40 is kept. PGA = `pga` [m/s2]; zero at both ends, and zero velocity and
/// displacement at the end. `motion` gives seed, duration and envelope; its target is only quoted
/// in messages. The same seed gives the same motion, to the bit on the same build. Throws UserError
/// for values out of range and for a target that stays out of reach.
Accelerogram generate_accelerogram(const TargetSpectrum& target, const SyntheticMotion& motion,
                                   double pga);

/// Doubts about a synthetic motion that are there before it is made. Throws UserError as
/// GroundMotion does, but for a target that stays out of reach. `name` is that of messages.
std::vector<std::string> synthetic_doubts(const std::string& name,
                                          const MotionComponent& component);

}  // namespace pounding
