#pragma once

#include <cstddef>
#include <vector>

#include "observers/observed_run.h"

namespace pounding {

/// Elements of a structure that this rank counts, that may yield and that were moved at all, for
/// FieldWriter: region, number in the mesh file, largest ductility, damage and energy lost [J] of
/// each. Local.
std::vector<double> yielding_elements(const ObservedRun& run, std::size_t structure);

}  // namespace pounding
