#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <mpi.h>

#include "common/saved_state.h"
#include "fidelity/window_place.h"
#include "model/model.h"
#include "model/model_scheme.h"
#include "motion/ground_motion.h"
#include "motion/response_spectrum.h"
#include "motion/spectrum_shape.h"
#include "scene/scene.h"

namespace pounding {

/// Floor spectra of channels, a channel being a direction of a probe.
using Spectra = std::vector<std::vector<SpectrumPoint>>;

/// Velocities of all channels in records that follow each other, the first of them made in a step.
struct Records {
  std::int64_t step = 0;
  std::span<const double> velocities;  ///< shape (records, channels) [m/s]
};

/// Spectra of the absolute acceleration of every channel, the mean from record to record, at the
/// scene's first damping ratio. The ranks share the channels out. Collective.
Spectra spectra_of(MPI_Comm comm, const Scene& scene, const Model& model,
                   const GroundMotion& motion, const Records& records);

/// The reduced run under a motion: velocities of the channels in all its records. `after_step` is
/// called after every one. Collective.
std::vector<double> run_reduced(MPI_Comm comm, const Scene& scene, const Model& model,
                                const GroundMotion& motion,
                                const std::function<void(ModelScheme&)>& after_step);

/// A reduced run and a window of it.
struct SeenWindow {
  Window window;
  SavedState state;                ///< in which the window begins
  std::vector<double> velocities;  ///< of the channels in all records [m/s]
  double impulse = 0;              ///< of all contacts in the window [N s]
};

/// Makes the reduced run. Collective.
SeenWindow see_window(MPI_Comm comm, const Scene& scene, const Model& model, Window window);

/// Distances of the channels that move.
std::vector<ChannelDistance> distances(const Model& model, const Spectra& found,
                                       const Spectra& reference, std::span<const char> moving);

/// Distance of spectra beyond which half a step or mesh size leaves so little of them that no order
/// shows.
inline constexpr double far_apart = 0.5;

/// Order p of an error of which half a step or mesh size changes spectra by `change`, and a quarter
/// in place of the half by `next`: 2^p = change / next, between 1 and 2, that of the scheme.
double order_of(double change, double next);

}  // namespace pounding
