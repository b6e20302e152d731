#include "driver/equipment_capacity.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "motion/accelerogram.h"
#include "motion/oscillator_history.h"
#include "scene/option_table.h"

namespace pounding {
namespace {

bool within(const std::array<double, 2>& band, double frequency) {
  return frequency >= band[0] && frequency <= band[1];
}

std::string option_of(const Equipment& item, std::string_view pattern) {
  return "option -" + option_name(pattern, {item.name});
}

TargetSpectrum read_capacity(const Scene& scene, const Equipment& item) {
  TargetSpectrum capacity =
      read_target_spectrum(item.capacity_file, "an acceleration of the capacity");
  for (double& value : capacity.ratio) value *= item.capacity_in_g ? standard_gravity : 1;
  const std::vector<double>& floor = scene.spectra.frequencies;
  const double low = std::max(capacity.frequency.front(), floor.front());
  const double high = std::min(capacity.frequency.back(), floor.back());
  const auto number = [](double value) { return sentence("{:.6g}", {value}); };
  const bool asked = item.band[0] > 0;
  if (asked && (item.band[0] < low || item.band[1] > high)) {
    throw UserError(option_of(item, "<equipment>_band") + " " + number(item.band[0]) + "," +
                    number(item.band[1]) + ": the capacity has " +
                    number(capacity.frequency.front()) + " to " +
                    number(capacity.frequency.back()) + " Hz, the floor spectra " +
                    number(floor.front()) + " to " + number(floor.back()) + " Hz");
  }
  const bool any = std::ranges::any_of(floor, [&](double frequency) {
    return frequency >= low && frequency <= high && within(item.band, frequency);
  });
  if (!any) {
    throw UserError(option_of(item, "<equipment>_capacity") + " " + item.capacity_file +
                    ": none of spectra_frequencies is among its " +
                    number(capacity.frequency.front()) + " to " +
                    number(capacity.frequency.back()) + " Hz" + (asked ? " and in the band" : ""));
  }
  return capacity;
}

/// Spectrum of the absolute acceleration of the item's cabinet on the floor of a spectrum.
ProbeSpectrum in_cabinet(const Scene& scene, const Equipment& item, const Recorder& recorder,
                         const ProbeSpectrum& floor) {
  const auto probe = std::ranges::find(recorder.probes(), item.probe, &ResolvedProbe::name);
  const auto d = std::ranges::find(direction_names, floor.direction) - direction_names.begin();
  const std::size_t channel =
      3 * static_cast<std::size_t>(probe - recorder.probes().begin()) + static_cast<std::size_t>(d);
  const std::vector<double> moved =
      recorder.acceleration(channel, recorder.first_record_from(scene.spectra.start));
  ProbeSpectrum spectrum = floor;
  spectrum.probe = item.name + " cabinet";
  spectrum.points = response_spectrum(
      oscillator_history(moved, recorder.interval(), item.cabinet_frequency, item.cabinet_damping),
      recorder.interval(), scene.spectra.frequencies, item.damping, AfterRecord::ignored);
  return spectrum;
}

}  // namespace

std::vector<TargetSpectrum> read_capacities(const Scene& scene) {
  std::vector<TargetSpectrum> capacities;
  for (const Equipment& item : scene.equipment) capacities.push_back(read_capacity(scene, item));
  return capacities;
}

std::vector<double> with_capacities(std::vector<double> frequencies,
                                    std::span<const TargetSpectrum> capacities) {
  constexpr double same = 1e-6;  // files hold few digits
  for (const TargetSpectrum& capacity : capacities) {
    for (const double frequency : capacity.frequency) {
      if (frequency < frequencies.front() || frequency > frequencies.back()) continue;
      const auto place = std::ranges::lower_bound(frequencies, frequency * (1 - same));
      if (*place > frequency * (1 + same)) frequencies.insert(place, frequency);
    }
  }
  return frequencies;
}

std::vector<ProbeSpectrum> cabinet_spectra(const Scene& scene, const Recorder& recorder,
                                           std::span<const ProbeSpectrum> floors) {
  std::vector<ProbeSpectrum> spectra;
  for (const Equipment& item : scene.equipment) {
    if (item.cabinet_frequency == 0) continue;
    for (const ProbeSpectrum& floor : floors) {
      const auto d = std::ranges::find(direction_names, floor.direction);
      if (floor.probe == item.probe && std::abs(floor.damping_ratio - item.damping) < 1e-9 &&
          item.directions[d - direction_names.begin()]) {
        spectra.push_back(in_cabinet(scene, item, recorder, floor));
      }
    }
  }
  return spectra;
}

Facts equipment_facts(const Scene& scene, std::span<const TargetSpectrum> capacities) {
  Facts facts;
  for (std::size_t i = 0; i < capacities.size(); ++i) {
    const Equipment& item = scene.equipment[i];
    Json of{{"probe", item.probe},
            {"directions", Json::array()},
            {"needed", 1 + item.margin},
            {"damping", item.damping},
            {"broadening", item.broadening},
            {"dip", item.dip},
            {"high_band", item.high_band},
            {"capacity",
             {{"frequency", capacities[i].frequency}, {"acceleration", capacities[i].ratio}}}};
    for (std::size_t d = 0; d < 3; ++d) {
      if (item.directions[d]) of["directions"].push_back(direction_names[d]);
    }
    if (item.band[0] > 0) of["band"] = item.band;
    if (item.cabinet_frequency > 0) {
      of["cabinet"] = {{"frequency", item.cabinet_frequency}, {"damping", item.cabinet_damping}};
    }
    facts.values["equipment"][item.name] = std::move(of);
  }
  return facts;
}

}  // namespace pounding
