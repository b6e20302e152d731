#pragma once

#include <string>

#include "mesh/raw_mesh.h"

namespace pounding {

/// Reads a universal file (.unv, as Salome, I-deas and others write it): nodes of dataset 2411,
/// elements of 2412, named groups of elements and of nodes of 2435, 2452, 2467 and 2477. A file
/// without groups has those of its elements' physical properties, by their numbers. Serial. Throws
/// UserError, with `option` at its head, the line and its content that is not read: other datasets
/// of nodes, elements, groups and coordinate systems, units other than metres, and for a file of
/// another kind.
RawMesh read_unv(const std::string& option, const std::string& file);

}  // namespace pounding
