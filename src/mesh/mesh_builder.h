#pragma once

#include "mesh/global_mesh.h"
#include "mesh/raw_mesh.h"
#include "scene/scene.h"

namespace pounding {

/// The mesh of a structure from the content of a mesh file: its regions as elements, every named
/// group as nodes and facets, groups of points, nodes that move together, clamped components.
/// Serial. Throws UserError (unknown group, wrong kind of element, an element in two regions).
GlobalMesh build_mesh(const Structure& structure, RawMesh raw);

}  // namespace pounding
