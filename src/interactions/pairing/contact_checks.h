#pragma once

#include <string>
#include <vector>

#include "interactions/pairing/interface.h"
#include "scene/scene.h"

namespace pounding::interactions {

/// Checks of the contacts of a scene for what cannot be meant, and what may not be: an overlap,
/// gaps of another unit, a structure that meets itself, a pair of faces listed twice, nodes that
/// have the other face behind them, facets inside a structure. docs/reference/input-checks.md has
/// the thresholds. Reads the interface's reports and adds to its warnings. Rank 0. Throws UserError
/// (an overlap that is too deep).
void check_contacts(const Scene& scene, Interface& interface);

/// The checks of a contact that are about its gaps: those of `report` may not be meant, one line
/// each. Throws UserError (an overlap that is too deep).
std::vector<std::string> check_gaps(const Contact& contact, const InterfaceReport& report,
                                    double model_size);

}  // namespace pounding::interactions
