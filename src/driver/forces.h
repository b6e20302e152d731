#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "driver/observed_run.h"
#include "driver/run_statistics.h"

namespace pounding {

/// Forces that the scene wants recorded: totals and those of elements, at the instants of the
/// samples, for the history; their peaks in `forces.csv`. Names of columns: "base.Fx",
/// "columns.17.My1". Each rank adds up its part, rank 0 gets the sums, so that a sample has one
/// message more. Peaks count samples from `spectra_start` on; a continued run may count them from
/// another time on where none that counted before it belongs to them. Throws UserError for groups
/// without such forces. Collective.
std::unique_ptr<Observer> make_forces(const ObservedRun& run);

}  // namespace pounding
