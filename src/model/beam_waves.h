#pragma once

#include <string>
#include <vector>

#include <mpi.h>

#include "common/types.h"
#include "mesh/mesh.h"
#include "modal/modal_analysis.h"
#include "scene/scene.h"

namespace pounding {

/// Beams of a region beside the waves that they are to carry.
struct BeamWaves {
  std::string group;
  double length = 0;        ///< of the longest [m]
  GlobalIndex heavier = 0;  ///< that were given rotary inertia, see elements/beam2.h
  double largest_part = 0;  ///< of it over their own [-]
};

/// Waves of the regions of beams of a structure, in their order. Collective over `comm`.
std::vector<BeamWaves> beam_waves(MPI_Comm comm, const Structure& structure, const Mesh& mesh);

/// Doubts about beams that are too long for the modes: one line for each region in which a mode has
/// fewer than two beams in half a wave of their bending.
std::vector<std::string> wave_doubts(const Structure& structure,
                                     const std::vector<BeamWaves>& waves,
                                     const std::vector<Mode>& modes);

/// Whether the mesh or the mass follows the highest frequency of the spectra.
bool follows_spectra(const Structure& structure, const std::vector<BeamWaves>& waves);

}  // namespace pounding
