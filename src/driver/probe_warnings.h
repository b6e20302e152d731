#pragma once

#include <span>
#include <string>
#include <vector>

#include "interactions/pairing/interface.h"
#include "mesh/global_mesh.h"
#include "mesh/probe_set.h"

namespace pounding {

/// Probes that may record something else than what is meant: far from the points asked for, on
/// clamped nodes, or on nodes of a contact. One line each. Serial, rank 0.
std::vector<std::string> probe_warnings(std::span<const ResolvedProbe> probes,
                                        std::span<const GlobalMesh> meshes,
                                        const interactions::Interface& interface);

}  // namespace pounding
