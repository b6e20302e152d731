#pragma once

#include <span>
#include <string>

#include "interactions/pairing/contact_face.h"
#include "scene/scene.h"

namespace pounding::interactions {

/// One side of a contact with the findings about its structure.
struct FaceSide {
  int structure = 0;
  const GlobalMesh* mesh = nullptr;  ///< null: a rigid wall
  ContactFace face;
  double thickness = 0;  ///< of the structure's thickest shell [m]
};

struct ContactSides {
  FaceSide secondary;
  FaceSide primary;
};

/// "option -joint_secondary left:face", of a side named secondary or primary; for messages.
std::string side_option(const Contact& contact, const std::string& side);

/// The faces of a contact, turned towards each other; `meshes` in the order of the scene's
/// structures and outliving the result. Serial, rank 0. Throws UserError (unknown group, group
/// without facets or wholly clamped, sides with common nodes, faces that do not face each other,
/// edges of shells in several planes beside a wall).
ContactSides find_sides(const Scene& scene, std::span<const GlobalMesh> meshes,
                        const Contact& contact);

}  // namespace pounding::interactions
