#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "motion/spectral_distance.h"

namespace pounding {

/// Error of a reduced run's floor spectra beside full order, see
/// fidelity/full_order_window.h; the same on every rank, but for the words.
struct FidelityEstimate {
  using Bands = std::array<double, compared_bands.size()>;
  double start = 0;                       ///< of the window [s]
  double end = 0;                         ///< [s]
  std::string reason;                     ///< for the place of the window; rank 0
  std::vector<ChannelDistance> channels;  ///< that move; rms with both parts, the largest of the
                                          ///< window's
  Bands rms{};                            ///< of all channels, per band: root of the sum of the
                                          ///< squares of the two parts [-]
  Bands window{};                         ///< of the part of the window [-]
  Bands spread{};                         ///< and of the run's answer to a small disturbance [-]
  double disturbance = 0;                 ///< part by which the ground's motion was changed [-]
  double impulse = 0;                     ///< in the window, of the reduced run [N s]
  double full_impulse = 0;                ///< and of full order [N s]
  std::size_t full_dofs = 0;
  double time_step = 0;      ///< of full order [s]
  double wall_time = 0;      ///< of the estimate [s]
  double full_run_time = 0;  ///< that the whole run would take at full order [s]
};

}  // namespace pounding
