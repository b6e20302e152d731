#pragma once

#include <vector>

#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding::interactions {

/// Absorbing faces of a structure as a whole, for the report.
struct AbsorbingReport {
  GlobalIndex nodes = 0;
  double area = 0;       ///< [m2]
  double base_area = 0;  ///< of it, where the motion enters [m2]
  /// Nodes where it enters, shape (nodes, 4): x, y, z [m] and the share of the area [m2].
  std::vector<double> base{};

  static void members(auto& self, auto& stream) {
    stream(self.nodes, self.area, self.base_area, self.base);
  }
};

/// Finds the nodes of a structure's absorbing faces, with the elements behind these, and puts them
/// into its mesh. Throws UserError (one line) for a group that is not in the mesh or has no facets,
/// a facet that is no outer face of a solid or is in two of the groups, a base that is not level or
/// does not look down, a motion along which every node of the base is clamped, and a node of the
/// base where the file of an incoherent wave says nothing. Serial.
AbsorbingReport find_absorbing_nodes(const Scene& scene, const Structure& structure,
                                     GlobalMesh& mesh);

}  // namespace pounding::interactions
