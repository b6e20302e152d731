#pragma once

#include <span>
#include <vector>

#include "motion/after_record.h"
#include "motion/oscillator_motion.h"

namespace pounding {

/// Largest |u| of every oscillator, in their order, under an acceleration sampled every `time_step`
/// [s], linear between samples: at the samples and wherever an extremum lies between them. The
/// oscillators start at rest. Those below oscillator::series_limit go side by side, and slow ones
/// are stepped and looked at only in the stretches of the record where the largest can lie
/// (stretch_bound.h), which changes it by round-off alone: those that move alike should follow each
/// other. `acceleration` is not empty.
std::vector<double> peak_displacements(std::span<const double> acceleration, double time_step,
                                       std::span<const oscillator::Oscillator> oscillators,
                                       AfterRecord after);

}  // namespace pounding
