#pragma once

#include <array>
#include <span>
#include <vector>

#include "motion/after_record.h"
#include "motion/oscillator_motion.h"

namespace pounding {

/// Largest |u| of every oscillator, in their order, under an acceleration sampled every `time_step`
/// [s], linear between samples: at the samples and wherever an extremum lies between them. The
/// oscillators start at rest. They go side by side: those that move alike should follow each other.
/// `acceleration` is not empty.
std::vector<double> peak_displacements(std::span<const double> acceleration, double time_step,
                                       std::span<const oscillator::Oscillator> oscillators,
                                       AfterRecord after);

/// Largest h |u'|, h^2 |u'' + a| and h^2 |u''| of an oscillator, likewise; h the time step.
std::array<double, 3> true_peaks(std::span<const double> acceleration, double time_step,
                                 const oscillator::Oscillator& oscillator, AfterRecord after);

}  // namespace pounding
