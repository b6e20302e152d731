#pragma once

#include <map>
#include <memory>
#include <string>

#include "mesh/raw_mesh.h"

namespace pounding {

class GroundMotion;

/// Inputs of a scene that are dear to make, for all models of it: a geometry is meshed and a motion
/// matched to its target once.
struct KeptInputs {
  std::map<std::string, RawAnswer> meshes;  ///< as Gmsh gave them, by structures; rank 0
  std::shared_ptr<const GroundMotion> motion;
};

}  // namespace pounding
