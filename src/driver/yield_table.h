#pragma once

#include <memory>

#include "driver/observed_run.h"

namespace pounding {

/// Ductility, lost energy, place and time of every element that yields by a law with a skeleton:
/// yielding.csv at the end of the run, and their sums by group and storey in the report.
std::unique_ptr<Observer> make_yield_table(const ObservedRun& run);

}  // namespace pounding
