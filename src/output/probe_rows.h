#pragma once

#include <span>
#include <vector>

#include "system/trace.h"

namespace pounding {

/// Means of places over probes of a structure in generalised coordinates: three rows per probe, for
/// x, y, z, over its coordinates, shape (3 probes, coordinates). `trace`: three components of every
/// node, probe after probe; `nodes`: number of nodes of each probe.
std::vector<double> probe_rows(const Trace& trace, std::span<const std::size_t> nodes);

/// The first record that counts of those that are made every `interval` [s], half a time step [s]
/// after which their intervals end: the middle of its interval is not before `start` [s].
std::size_t first_record_from(double start, double time_step, double interval);

}  // namespace pounding
