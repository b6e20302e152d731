#pragma once

#include <span>
#include <string>
#include <vector>

#include "driver/facts.h"
#include "driver/floor_spectra.h"
#include "motion/synthetic.h"
#include "scene/scene.h"

namespace pounding {

/// Capacity of an item of equipment over the spectrum that its floor asks for, in one direction, at
/// the frequencies that the capacity has.
struct EquipmentDemand {
  std::string direction;
  std::vector<double> frequencies;  ///< [Hz]
  std::vector<double> required;     ///< floor response spectrum, widened [m/s2]
  std::vector<double> capacity;     ///< test response spectrum [m/s2]
  double ratio = 0;       ///< smallest of capacity over required in the band that counts [-]
  double frequency = 0;   ///< at which [Hz]
  double high_ratio = 0;  ///< smallest in the item's high band [-]; infinite if that has no point
  bool passes = false;    ///< with the item's margin and dips
};

/// The demands on an item in its directions, the most severe first decides.
struct EquipmentVerdict {
  std::vector<EquipmentDemand> demands;
  bool passes() const;
  const EquipmentDemand& severest() const;
};

/// Capacities of the scene's equipment, in its order [m/s2]. Throws UserError: a file that is no
/// spectrum, a band that the capacity or the floor spectra do not have. Serial.
std::vector<TargetSpectrum> read_capacities(const Scene& scene);

/// Every item of the scene beside the spectrum of its probe at its damping ratio: widened to both
/// sides, capacity over required from the frequencies that both have and the item's band contains.
/// In a cabinet the spectrum is that of the cabinet's absolute acceleration, an oscillator on the
/// floor. Rank 0, after the recorder finished.
///
/// It passes in a direction where the ratio is 1 + margin everywhere; `dip` of that may lack where
/// the frequencies a sixth of an octave below and above have all of it.
std::vector<EquipmentVerdict> judge_equipment(const Scene& scene,
                                              std::span<const TargetSpectrum> capacities,
                                              std::span<const ProbeSpectrum> spectra,
                                              const Recorder& recorder);

/// `equipment.csv`: required and capacity by item, direction and frequency. Throws UserError if it
/// cannot be written.
void write_equipment(const std::string& path, const Scene& scene,
                     std::span<const EquipmentVerdict> verdicts, int digits);

Facts equipment_facts(const Scene& scene, std::span<const EquipmentVerdict> verdicts);

}  // namespace pounding
