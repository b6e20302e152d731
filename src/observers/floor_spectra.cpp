#include "observers/floor_spectra.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "common/facts_of.h"
#include "common/parallel.h"
#include "io/csv_file.h"
#include "motion/oscillator_step.h"
#include "motion/signal_treatment.h"
#include "scene/option_table.h"

namespace pounding {
namespace {

const ResultFile spectrum_table{
    "spectra.csv", "response spectra of floors, cabinets and the ground", spectrum_columns};

/// The accelerations of the channels that this rank works on: number rank, rank + size, ...; from
/// record `first` on.
std::vector<std::vector<double>> share_accelerations(MPI_Comm comm, std::size_t channels,
                                                     const Recorder& recorder, std::size_t first) {
  const std::size_t ranks = size_of(comm);
  std::vector<std::vector<double>> mine;
  for (std::size_t channel = 0; channel < channels; ++channel) {
    const auto worker = static_cast<int>(channel % ranks);
    if (rank_of(comm) == 0 && worker != 0) {
      send_array(comm, worker, recorder.acceleration(channel, first));
    } else if (rank_of(comm) == worker) {
      std::vector<double>& acceleration = mine.emplace_back();
      if (worker == 0) {
        acceleration = recorder.acceleration(channel, first);
      } else {
        receive_array(comm, 0, acceleration);
      }
    }
  }
  return mine;
}

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
  refuse_if(asked && (item.band[0] < low || item.band[1] > high),
            option_of(item, "<equipment>_band") + " " + number(item.band[0]) + "," +
                number(item.band[1]) + ": the capacity has " + number(capacity.frequency.front()) +
                " to " + number(capacity.frequency.back()) + " Hz, the floor spectra " +
                number(floor.front()) + " to " + number(floor.back()) + " Hz");
  const bool any = std::ranges::any_of(floor, [&](double frequency) {
    return frequency >= low && frequency <= high && within(item.band, frequency);
  });
  refuse_if(!any, option_of(item, "<equipment>_capacity") + " " + item.capacity_file +
                      ": none of spectra_frequencies is among its " +
                      number(capacity.frequency.front()) + " to " +
                      number(capacity.frequency.back()) + " Hz" +
                      (asked ? " and in the band" : ""));
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

std::vector<ProbeSpectrum> compute_floor_spectra(MPI_Comm comm, const Scene& scene,
                                                 const Recorder& recorder) {
  const std::size_t channels = 3 * recorder.probes().size();
  const std::vector<double>& ratios = scene.spectra.damping_ratios;
  const auto accelerations = share_accelerations(comm, channels, recorder,
                                                 recorder.first_record_from(scene.spectra.start));
  std::vector<std::vector<SpectrumPoint>> mine;  // per channel and damping ratio
  on_every_rank(comm, [&] {
    for (const std::vector<double>& acceleration : accelerations) {
      // A run is cut, it does not end: the floor still moves, so nothing is said of its motion
      // afterwards.
      for (auto& spectrum :
           response_spectra(acceleration, recorder.interval(), scene.spectra.frequencies, ratios,
                            AfterRecord::ignored)) {
        mine.push_back(std::move(spectrum));
      }
    }
  });
  if (rank_of(comm) != 0) {
    for (const std::vector<SpectrumPoint>& points : mine) send_array(comm, 0, points);
    return {};
  }
  const std::size_t ranks = size_of(comm);
  std::vector<ProbeSpectrum> spectra;
  for (std::size_t channel = 0; channel < channels; ++channel) {
    for (std::size_t r = 0; r < ratios.size(); ++r) {
      ProbeSpectrum& spectrum = spectra.emplace_back();
      spectrum.probe = recorder.probes()[channel / 3].name;
      spectrum.direction = direction_names[channel % 3];
      spectrum.damping_ratio = ratios[r];
      spectrum.interval = recorder.interval();
      spectrum.valid_up_to = faithful_up_to(recorder.interval());
      if (channel % ranks == 0) {
        spectrum.points = std::move(mine[channel / ranks * ratios.size() + r]);
      } else {
        receive_array(comm, static_cast<int>(channel % ranks), spectrum.points);
      }
    }
  }
  return spectra;
}

std::vector<ProbeSpectrum> compute_ground_spectra(const Scene& scene, const GroundMotion& motion) {
  std::vector<ProbeSpectrum> spectra;
  if (std::ranges::find(scene.probes, ground_name, &Probe::name) != scene.probes.end()) return {};
  for (std::size_t d = 0; d < 3; ++d) {
    if (!motion.active(static_cast<int>(d))) continue;
    const double step = motion.component(static_cast<int>(d)).time_step;
    std::vector<double> samples;
    const auto last = static_cast<std::int64_t>(scene.end_time / step + 1e-6);
    auto k = static_cast<std::int64_t>(std::ceil(scene.spectra.start / step - 1e-6));
    for (; k <= last; ++k) {
      samples.push_back(motion.acceleration(static_cast<int>(d), static_cast<double>(k) * step));
    }
    if (samples.size() < 2) continue;
    const std::vector<double>& ratios = scene.spectra.damping_ratios;
    auto points =
        response_spectra(samples, step, scene.spectra.frequencies, ratios, AfterRecord::ignored);
    for (std::size_t r = 0; r < ratios.size(); ++r) {
      spectra.push_back(
          {ground_name, direction_names[d], ratios[r], step, 0.5 / step, std::move(points[r])});
    }
  }
  return spectra;
}

OutputKind spectra_output() {
  return {{spectrum_table}};
}

void write_floor_spectra(const Scene& scene, std::span<const ProbeSpectrum> spectra) {
  ResultTable file(scene, spectrum_table);
  for (const ProbeSpectrum& spectrum : spectra) {
    const std::string label = spectrum.probe + "," + spectrum.direction + ",complete";
    for (const SpectrumPoint& point : spectrum.points) {
      file.row(label, {spectrum.damping_ratio, point.frequency, 1 / point.frequency,
                       point.displacement, point.pseudo_velocity, point.pseudo_acceleration,
                       spectrum.interval, spectrum.valid_up_to, scene.spectra.start, 0});
    }
  }
  file.close();
}

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
    Json of = FACTS_OF(item, probe, damping, broadening, dip, high_band);
    of.update({{"directions", Json::array()},
               {"needed", 1 + item.margin},
               {"capacity",
                {{"frequency", capacities[i].frequency}, {"acceleration", capacities[i].ratio}}}});
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

double stated_frequency(const Scene& scene, double interval) {
  return std::min(scene.spectra.peak_frequency, low_pass_limit / interval);
}

double stated_peak(std::span<const double> acceleration, double interval, double frequency,
                   std::size_t first) {
  const std::vector<double> filtered = low_pass(acceleration, interval, frequency);
  double peak = 0;
  for (std::size_t i = first; i < filtered.size(); ++i) {
    peak = std::max(peak, std::abs(filtered[i]));
  }
  return peak;
}

StatedPeaks stated_peaks(const Scene& scene, const Recorder& recorder) {
  StatedPeaks peaks;
  peaks.frequency = stated_frequency(scene, recorder.interval());
  const std::size_t first = recorder.first_record_from(scene.spectra.start);
  for (std::size_t channel = 0; channel < recorder.channels().size(); ++channel) {
    peaks.acceleration.push_back(
        stated_peak(recorder.acceleration(channel), recorder.interval(), peaks.frequency, first));
  }
  return peaks;
}

}  // namespace pounding
