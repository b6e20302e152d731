#pragma once

#include <string>

#include "driver/model.h"

namespace pounding {

/// `modes.h5`: per structure a group with
///     coordinates          (nodes, 3) [m], nodes in file order
///     frequencies          (modes) [Hz]
///     shapes/0001 ...      (nodes, 3 or 6) x, y, z and the rotations about them, phi^T M phi = 1;
///                          0 where a node is clamped or has no rotation
/// The sign of a shape has no meaning. Needs modes with their shapes. Throws std::runtime_error if
/// the file cannot be written. Collective.
void write_mode_shapes(MPI_Comm comm, const std::string& path, const Model& model);

}  // namespace pounding
