#include "driver/equipment_demand.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.h"
#include "io/csv_file.h"
#include "motion/accelerogram.h"
#include "motion/oscillator_history.h"
#include "motion/spectrum_shape.h"
#include "scene/option_table.h"

namespace pounding {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool within(const std::array<double, 2>& band, double frequency) {
  return frequency >= band[0] && frequency <= band[1];
}

double ratio_of(double capacity, double required) {
  return required > 0 ? capacity / required : infinity;
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

/// Whether a point that lacks a part of the ratio needed is a dip between two that have all of it.
bool is_dip(const Equipment& item, const TargetSpectrum& capacity, const TargetSpectrum& required,
            double frequency, double ratio) {
  const double needed = 1 + item.margin;
  if (ratio < needed * (1 - item.dip)) return false;
  const double sixth = std::exp2(1.0 / 6);
  return std::ranges::all_of(std::array{frequency / sixth, frequency * sixth}, [&](double beside) {
    return ratio_of(capacity.at(beside), required.at(beside)) >= needed;
  });
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
  spectrum.points = response_spectrum(
      oscillator_history(moved, recorder.interval(), item.cabinet_frequency, item.cabinet_damping),
      recorder.interval(), scene.spectra.frequencies, item.damping, AfterRecord::ignored);
  return spectrum;
}

EquipmentDemand demand_of(const Equipment& item, const TargetSpectrum& capacity,
                          const ProbeSpectrum& spectrum) {
  TargetSpectrum floor;
  for (const SpectrumPoint& point : spectrum.points) {
    floor.frequency.push_back(point.frequency);
    floor.ratio.push_back(point.pseudo_acceleration);
  }
  floor.ratio = broadened(floor.frequency, floor.ratio, item.broadening);
  EquipmentDemand demand;
  demand.direction = spectrum.direction;
  demand.ratio = demand.high_ratio = infinity;
  demand.frequency = floor.frequency.front();
  demand.passes = true;
  for (std::size_t i = 0; i < floor.frequency.size(); ++i) {
    const double frequency = floor.frequency[i];
    if (frequency < capacity.frequency.front() || frequency > capacity.frequency.back()) continue;
    demand.frequencies.push_back(frequency);
    demand.required.push_back(floor.ratio[i]);
    demand.capacity.push_back(capacity.at(frequency));
    const double ratio = ratio_of(demand.capacity.back(), demand.required.back());
    if (within(item.high_band, frequency)) demand.high_ratio = std::min(demand.high_ratio, ratio);
    if (!within(item.band, frequency)) continue;
    if (ratio < demand.ratio) {
      demand.ratio = ratio;
      demand.frequency = frequency;
    }
    if (ratio < 1 + item.margin && !is_dip(item, capacity, floor, frequency, ratio)) {
      demand.passes = false;
    }
  }
  return demand;
}

Json finite_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

}  // namespace

bool EquipmentVerdict::passes() const {
  return std::ranges::all_of(demands, &EquipmentDemand::passes);
}

const EquipmentDemand& EquipmentVerdict::severest() const {
  return *std::ranges::min_element(demands, {}, &EquipmentDemand::ratio);
}

std::vector<TargetSpectrum> read_capacities(const Scene& scene) {
  std::vector<TargetSpectrum> capacities;
  for (const Equipment& item : scene.equipment) capacities.push_back(read_capacity(scene, item));
  return capacities;
}

std::vector<EquipmentVerdict> judge_equipment(const Scene& scene,
                                              std::span<const TargetSpectrum> capacities,
                                              std::span<const ProbeSpectrum> spectra,
                                              const Recorder& recorder) {
  std::vector<EquipmentVerdict> verdicts;
  for (std::size_t i = 0; i < scene.equipment.size(); ++i) {
    const Equipment& item = scene.equipment[i];
    EquipmentVerdict& verdict = verdicts.emplace_back();
    for (const ProbeSpectrum& spectrum : spectra) {
      const auto d = std::ranges::find(direction_names, spectrum.direction);
      if (spectrum.probe == item.probe && std::abs(spectrum.damping_ratio - item.damping) < 1e-9 &&
          item.directions[d - direction_names.begin()]) {
        verdict.demands.push_back(demand_of(
            item, capacities[i],
            item.cabinet_frequency > 0 ? in_cabinet(scene, item, recorder, spectrum) : spectrum));
      }
    }
  }
  return verdicts;
}

void write_equipment(const std::string& path, const Scene& scene,
                     std::span<const EquipmentVerdict> verdicts, int digits) {
  CsvFile file(path, digits);
  file.header("equipment,direction,counted,frequency,required,capacity");
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    for (const EquipmentDemand& demand : verdicts[i].demands) {
      const std::string label = scene.equipment[i].name + "," + demand.direction;
      for (std::size_t k = 0; k < demand.frequencies.size(); ++k) {
        const bool counted = within(scene.equipment[i].band, demand.frequencies[k]);
        file.row(label + (counted ? ",1" : ",0"),
                 {demand.frequencies[k], demand.required[k], demand.capacity[k]});
      }
    }
  }
  file.close();
}

Facts equipment_facts(const Scene& scene, std::span<const EquipmentVerdict> verdicts) {
  Facts facts;
  if (verdicts.empty()) return facts;
  facts.text =
      "\nequipment: smallest ratio of its capacity over the widened spectrum of its floor\n"
      "item           passes  ratio      at  along   needed   high band   probe\n";
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const Equipment& item = scene.equipment[i];
    const EquipmentDemand& worst = verdicts[i].severest();
    Json of{{"probe", item.probe},
            {"passes", verdicts[i].passes()},
            {"ratio", finite_or_null(worst.ratio)},
            {"frequency", worst.frequency},
            {"direction", worst.direction},
            {"needed", 1 + item.margin},
            {"damping", item.damping},
            {"broadening", item.broadening},
            {"dip", item.dip},
            {"high_band", item.high_band}};
    double high = infinity;
    for (const EquipmentDemand& demand : verdicts[i].demands) {
      high = std::min(high, demand.high_ratio);
      // The spectrum at its highest frequency is the peak of the floor's own acceleration.
      of["directions"][demand.direction] = {{"passes", demand.passes},
                                            {"ratio", finite_or_null(demand.ratio)},
                                            {"frequency", demand.frequency},
                                            {"high_band_ratio", finite_or_null(demand.high_ratio)},
                                            {"required_at_zero_period", demand.required.back()},
                                            {"capacity_at_zero_period", demand.capacity.back()}};
    }
    of["high_band_ratio"] = finite_or_null(high);
    facts.text += sentence("{:-14s} {:-6s}", {item.name, verdicts[i].passes() ? "yes" : "NO"});
    facts.text +=
        std::isfinite(worst.ratio)
            ? sentence("{:7.3f} {:7.4g}  {:-5s}", {worst.ratio, worst.frequency, worst.direction})
            : sentence("  no motion            ", {});
    facts.text += sentence("{:9.3f}", {1 + item.margin});
    facts.text += std::isfinite(high) ? sentence("   {:9.3f}", {high}) : "           -";
    facts.text += "   " + item.probe + "\n";
    if (item.cabinet_frequency > 0) {
      of["cabinet"] = {{"frequency", item.cabinet_frequency}, {"damping", item.cabinet_damping}};
    }
    facts.values["equipment"][item.name] = std::move(of);
  }
  return facts;
}

}  // namespace pounding
