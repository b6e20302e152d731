#pragma once

#include <memory>

#include "driver/observed_run.h"

namespace pounding {

/// Pairs are found once, in the initial geometry. This keeps how far each node has moved along the
/// facet that it faces, whether they touch or not, on the ranks that have displacements of the
/// interface. It reads displacements and changes nothing; nothing allocates after construction. Of
/// a run with contacts. Collective.
std::unique_ptr<Observer> make_slide_watch(const ObservedRun& run);

}  // namespace pounding
