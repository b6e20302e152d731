#pragma once

#include <span>
#include <vector>

#include "driver/facts.h"
#include "driver/floor_spectra.h"
#include "motion/synthetic.h"
#include "scene/scene.h"

namespace pounding {

/// Capacities of the scene's equipment, in its order [m/s2]. Throws UserError: a file that is no
/// spectrum, a band that the capacity or the floor spectra do not have. Serial.
std::vector<TargetSpectrum> read_capacities(const Scene& scene);

/// Increasing frequencies of floor spectra with those of the capacities that lie between the first
/// and the last of them: a capacity has its corners there.
std::vector<double> with_capacities(std::vector<double> frequencies,
                                    std::span<const TargetSpectrum> capacities);

/// Spectra of items in a cabinet, an oscillator on the floor: those of the cabinet's absolute
/// acceleration at the damping ratio and in the directions of the item, with `<item> cabinet` in
/// place of a probe. `floors`: spectra of the probes. Rank 0, after the recorder finished.
std::vector<ProbeSpectrum> cabinet_spectra(const Scene& scene, const Recorder& recorder,
                                           std::span<const ProbeSpectrum> floors);

/// Places and capacities of the items, and the rules that python/pounding judges them by.
Facts equipment_facts(const Scene& scene, std::span<const TargetSpectrum> capacities);

}  // namespace pounding
