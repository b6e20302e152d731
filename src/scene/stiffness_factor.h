#pragma once

#include "scene/option_reader.h"
#include "scene/structure.h"

/// Factors on the stiffness of structures and of their regions.
namespace pounding {

/// Multiplies the stiffness of a region's elements: Young's modulus, springs, and those of its
/// laws, whose forces stay and whose elongations are divided by the factor.
void scale_stiffness(double factor, Region& region);

/// Multiplies that of all its regions; soil under its mat is none of them.
void scale_stiffness(double factor, Structure& structure);

/// The factor of a reduction on its squared frequencies and regions, once its basis is known. 1
/// where its regions have it already: at full order, and where soil or forces at rest have a part
/// in the modes. Throws UserError beside files of matrices at full order.
double read_stiffness_factor(OptionReader& options, Structure& structure);

}  // namespace pounding
