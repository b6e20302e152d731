#pragma once

#include <memory>

#include "links/link_law.h"
#include "scene/scene.h"

namespace pounding {

/// Law of the links of a region, by what its options say: the only place that chooses among laws.
/// `length` [m] of the element, `beta` [s] of its structure's damping, `time_step` [s].
std::unique_ptr<LinkLaw> law_of(const Region& region, double length, double beta, double time_step);

}  // namespace pounding
