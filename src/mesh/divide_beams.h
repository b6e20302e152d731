#pragma once

#include <string>
#include <vector>

#include "common/types.h"
#include "mesh/raw_mesh.h"
#include "scene/scene.h"

namespace pounding {

/// Lines of a region that were cut into beams.
struct DividedLines {
  std::string group;
  GlobalIndex lines = 0;  ///< as in the mesh
  GlobalIndex beams = 0;  ///< that they became
  GlobalIndex whole = 0;  ///< of the lines, edges of other elements, which stay as they are

  static void members(auto& self, auto& stream) {
    stream(self.group, self.lines, self.beams, self.whole);
  }
};

/// Beams in a half wave of bending that `divide: auto` asks for.
inline constexpr int beams_per_half_wave = 4;

/// Cuts the lines of regions of beams into equal parts, as many as the region says or as bending up
/// to its resolved frequency needs. New nodes have tags beyond those of the file, and so have all
/// but the first part of a line; every group that has the line, or one between the same nodes
/// without elements, has all of it. Lines are left whole that are edges of surfaces or belong to
/// other regions as well. Serial. Throws UserError where more than a thousand parts are needed.
/// `splits`: how often the lines were split before, of which parts by bending are as much finer.
std::vector<DividedLines> divide_beams(const Structure& structure, RawMesh& mesh, int splits = 0);

}  // namespace pounding
