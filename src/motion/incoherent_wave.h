#pragma once

#include <span>
#include <string>
#include <vector>

#include "motion/accelerogram.h"
#include "scene/scene.h"

namespace pounding {

/// Histories of the shapes in which nodes of a base part from a wave from below, along x, y, z, by
/// an HDF5 file of run/incoherent:
///
///     time_step         attribute [s]
///     nodes             (nodes, 3) [m]
///     x/record          (samples) the acceleration that they were made of [m/s2]; y, z likewise
///     x/histories       (shapes, samples) of accelerations along x [m/s2]
///     x/shapes          (nodes, shapes)
///
/// They get the factor that the wave has on that record, its start, and its resampling. `wave`:
/// along x, y, z. Throws UserError: no such file, another record, axes that the wave has not or has
/// alone. Every rank may do so.
std::vector<Accelerogram> read_incoherent_wave(const std::string& file,
                                               std::span<const Accelerogram> wave,
                                               Resampling resampling);

}  // namespace pounding
