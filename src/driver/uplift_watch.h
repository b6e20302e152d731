#pragma once

#include <memory>

#include "driver/observed_run.h"

namespace pounding {

/// Contact ratio of every structure that has compression-only springs, at the lines of the energy
/// ledger.
std::unique_ptr<Observer> make_uplift_watch(const ObservedRun& run);

}  // namespace pounding
