#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mesh/global_mesh.h"
#include "mesh/raw_mesh.h"

namespace pounding {

/// The lines, surfaces and volumes of a file that no region of the scene takes, group by group, and
/// those in no group at all that no other entity ends on. A surface that is a face of hexahedra in
/// use, and a line that is an edge of shells or an element in use, marks a place only: it is not
/// left out. `taken`: the groups, by name and dimension, that regions take. Serial.
std::vector<UnusedElements> find_unused(const RawMesh& raw, const GlobalMesh& mesh,
                                        const std::set<std::pair<std::string, int>>& taken);

}  // namespace pounding
