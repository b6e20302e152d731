#pragma once

#include <memory>

#include "interactions/laws/hysteresis_path.h"

namespace pounding::interactions {

/// Path of a law by its rule.
std::unique_ptr<HysteresisPath> make_path(const Hysteresis& law);

}  // namespace pounding::interactions
