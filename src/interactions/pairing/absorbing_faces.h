#pragma once

#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding::interactions {

/// Absorbing faces of a structure as a whole, for the report.
struct AbsorbingReport {
  GlobalIndex nodes = 0;
  double area = 0;       ///< [m2]
  double base_area = 0;  ///< of it, where the motion enters [m2]
};

/// Finds the nodes of a structure's absorbing faces, with the elements behind these, and puts them
/// into its mesh. Throws UserError (one line) for a group that is not in the mesh or has no facets,
/// a facet that is no outer face of a solid or is in two of the groups, a base that is not level or
/// does not look down, and a motion along which every node of the base is clamped. Serial.
AbsorbingReport find_absorbing_nodes(const Scene& scene, const Structure& structure,
                                     GlobalMesh& mesh);

}  // namespace pounding::interactions
