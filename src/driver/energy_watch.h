#pragma once

#include <memory>

#include "driver/observed_run.h"

namespace pounding {

/// Lines of the energy ledger: `energy.csv`. Each stops a run whose numbers cannot be trusted
/// (watchdog.h), and the bounds of the gap rates go by it.
std::unique_ptr<Observer> make_energy_watch(const ObservedRun& run);

}  // namespace pounding
