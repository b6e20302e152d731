#pragma once

#include <string>

#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding {

/// The highest frequency whose waves a mesh carries. An element carries waves up to the frequency
/// at which they are as long as six of it, beams with shear as long as four, in an endless body of
/// its own:
///
///     solids   shear, (G / rho)^1/2; those alone between two free faces bend as plates
///     shells   bending of a strip with shear, by its flexibility and mass per area
///     beams    bending with shear in the softer plane, bars stretch
///
/// Lumped masses and linear elements then err by 5 % of the frequency: the waves of a row are
/// slower by sin(x) / x in stretch and shear, faster by sin(x) tan(x) / x^2 in bending, x = pi / 6;
/// those of euler_beam slower by (1 + x^2 / 3)^-1/2, whose halves of beams turn with their nodes,
/// those of beam by less than 1 %. Shells, thin solids and beams with other elements at all
/// nodes are whole spans between these, where no such wave is: they follow those up to a part of
/// the frequency of one half wave in the span.
struct MeshWaves {
  double frequency = 0;  ///< that elements of nine tenths of the mass carry [Hz]; 0: few carry any
  double element_size = 0;  ///< of those that carry no more [m]
  std::string group;        ///< that they are of

  static void members(auto& self, auto& stream) {
    stream(self.frequency, self.element_size, self.group);
  }
};

/// Elements of rigid bodies carry no waves. Serial.
MeshWaves mesh_waves(const Structure& structure, const GlobalMesh& mesh);

}  // namespace pounding
