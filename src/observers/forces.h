#pragma once

#include <array>

#include "observers/observed_run.h"

namespace pounding {

/// Components of a total, in their order.
inline constexpr std::array<const char*, 6> total_force_names{"Fx", "Fy", "Fz", "Mx", "My", "Mz"};

/// Forces that the scene wants recorded: totals and those of elements, at the instants of the
/// samples, for the history; their peaks in `forces.csv`. Names of columns: "base.Fx",
/// "columns.17.My1". Each rank adds up its part, rank 0 gets the sums, so that a sample has one
/// message more. Peaks count samples from `spectra_start` on; a continued run may count them from
/// another time on where none that counted before it belongs to them. Throws UserError for groups
/// without such forces. Collective.
OutputKind forces_output();

}  // namespace pounding
