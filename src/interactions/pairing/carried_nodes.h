#pragma once

#include <vector>

#include "interactions/pairing/contact_face.h"
#include "mesh/global_mesh.h"

namespace pounding::interactions {

/// Nodes of a face that ties let follow none but other nodes of it: what these carry in contact
/// holds them too, so that rows of both would share it in no unique way. `has_row`: per node of the
/// face, whether it faces something. Carriers that are clamped altogether need no row. One value
/// per node of the face, 1 for those; serial.
std::vector<char> carried_nodes(const GlobalMesh& mesh, const ContactFace& face,
                                const std::vector<char>& has_row);

}  // namespace pounding::interactions
