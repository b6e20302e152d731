#pragma once

#include <memory>

#include "driver/observed_run.h"

namespace pounding {

/// Links that the scene wants recorded: finds them, has their steps record them, and brings
/// elongation and force of each to the history. A link is named after its item, the element's
/// number in the mesh file, and the component ("frame:pads.17.x", a bar's "axial", a dashpot's
/// "x.dashpot"); a pair with filler after its contact and its number among the pairs. Throws
/// UserError for a group without links. Collective.
std::unique_ptr<Observer> make_loops(const ObservedRun& run);

}  // namespace pounding
