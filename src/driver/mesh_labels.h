#pragma once

#include "driver/model.h"
#include "output/mesh_grid.h"

namespace pounding {

/// Groups and contacts of a scene as its pictures name them. Local.
MeshLabels mesh_labels(const Scene& scene, const interactions::Interface& interface);

}  // namespace pounding
