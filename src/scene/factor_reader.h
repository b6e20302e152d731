#pragma once

#include <string>

#include "scene/option_reader.h"
#include "scene/scene.h"

/// Factors by which a study varies structures that are otherwise the same.
namespace pounding {

/// Factor on the damping of a structure: its readers multiply their values by it.
double read_damping_factor(OptionReader& options, const std::string& structure);

/// The factor on the stiffness of a structure whose other options are read. Its regions get it at
/// full order; frequencies and regions of a reduction get it once the basis is known. Throws
/// UserError where part of the stiffness would not follow: links, soil, files of matrices, P-Delta,
/// absorbing faces of a reduction.
double read_stiffness_factor(OptionReader& options, Structure& structure);

/// Multiplies Young's moduli and springs of a structure's regions.
void scale_stiffness(double factor, Structure& structure);

}  // namespace pounding
