#pragma once

#include <memory>

#include "interactions/laws/element_law.h"
#include "mesh/mesh.h"
#include "scene/scene.h"

namespace pounding {

/// Law of the shells of a region that yield in shear in their plane. The shear strain at the centre
/// is its mean over the element, whatever the shape, and the modes of shell4 have none of it, so
///
///     G V g^2 / 2,      g = mean of g12, V the volume
///
/// is a part of the membrane's energy beside which the rest is positive or zero. The stress over g
/// follows the law, all else is K u: the other strains, the shear that varies within the element,
/// bending, drilling. 1 and 2 are the axes of the shell's forces (shell_force_axes). Throws
/// UserError for an element that cannot be. Local.
std::shared_ptr<interactions::ElementLaw> yielding_shells(const Structure& structure,
                                                          const Mesh& mesh, int region);

}  // namespace pounding
