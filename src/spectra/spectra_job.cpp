#include "spectra/spectra_job.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "common/error.h"
#include "common/facts.h"
#include "io/csv_file.h"
#include "motion/response_spectrum.h"
#include "motion/spectrum_shape.h"
#include "observers/impact_catalogue.h"
#include "spectra/signal_reader.h"

namespace pounding {

namespace {

/// One line of the result: a signal or envelope, a treatment, a damping ratio, and its columns.
struct Spectrum {
  std::string source;  ///< probe and direction as the table has them
  Treatment treatment = Treatment::complete;
  double damping_ratio = 0;
  std::vector<std::vector<double>> columns;  ///< shape (quantities, frequencies)
};

/// A signal with its peaks, if they are asked for.
struct Input {
  NamedSignal named;
  std::vector<SignalPeak> peaks;
  double dirac_step = 0;
};

/// Probe and direction of a channel of a history; a record has its name and no direction.
std::string source_of(const NamedSignal& named) {
  const std::size_t dot = named.is_history ? named.name.rfind('.') : std::string::npos;
  if (dot == std::string::npos) return named.name + ",";
  return named.name.substr(0, dot) + "," + named.name.substr(dot + 1);
}

bool asked(const SpectraOptions& options, Treatment treatment) {
  return std::ranges::find(options.treatments, treatment) != options.treatments.end();
}

std::vector<TimeWindow> contact_windows(const SpectraOptions& options, const NamedSignal& named) {
  refuse_if(options.impacts.empty() && !named.is_history,
            named.name + " is a record: its impacts are known only from --impacts FILE");
  const std::string path =
      options.impacts.empty() ? named.folder + "/impacts.csv" : options.impacts;
  const auto impacts = read_impact_windows(path);
  std::vector<TimeWindow> windows;
  for (const NamedWindow& impact : impacts) {
    if (options.contacts.empty() ||
        std::ranges::find(options.contacts, impact.contact) != options.contacts.end()) {
      windows.push_back({impact.start, impact.end});
    }
  }
  refuse_if(windows.empty(), path + ": no impact" + (impacts.empty() ? "" : " of these contacts") +
                                 ", so there are no peaks to keep or to leave out");
  return windows;
}

double time_step_of_run(const NamedSignal& named) {
  const std::string path = named.folder + "/summary.json";
  require_finite_file(path);
  const auto summary = nlohmann::json::parse(std::ifstream(path), nullptr, false);
  const auto found = summary.is_object() ? summary.find("time_step") : summary.end();
  refuse_if(!summary.is_object() || found == summary.end() || !found->is_number(),
            path + " does not state the time step of the run; give --dirac-step");
  return found->get<double>();
}

Input prepare(const SpectraOptions& options, NamedSignal named) {
  Input input{std::move(named), {}, options.dirac_step};
  if (options.peaks.empty() && options.treatments == std::vector{Treatment::complete}) return input;
  input.peaks =
      find_peaks(input.named.signal, contact_windows(options, input.named), options.margin);
  refuse_if(input.peaks.empty(), input.named.name + ": the impacts lie outside the signal");
  if (input.dirac_step == 0 && asked(options, Treatment::dirac)) {
    input.dirac_step = time_step_of_run(input.named);
  }
  return input;
}

AfterRecord after(const SpectraOptions& options, const Input& input, Treatment treatment) {
  if (treatment == Treatment::dirac) return AfterRecord::free_vibration;
  const bool ignored =
      options.after == "ignored" || (options.after == "auto" && input.named.is_history);
  return ignored ? AfterRecord::ignored : AfterRecord::free_vibration;
}

/// Pseudo columns of a spectrum.
std::vector<std::vector<double>> columns_of(const std::vector<SpectrumPoint>& spectrum) {
  std::vector<std::vector<double>> columns(3);
  for (const SpectrumPoint& point : spectrum) {
    columns[0].push_back(point.displacement);
    columns[1].push_back(point.pseudo_velocity);
    columns[2].push_back(point.pseudo_acceleration);
  }
  return columns;
}

std::vector<std::vector<double>> compute(const SpectraOptions& options, const SampledSignal& signal,
                                         double ratio, AfterRecord after_record) {
  std::vector<std::vector<double>> columns = columns_of(response_spectrum(
      signal.acceleration, signal.time_step, options.frequencies, ratio, after_record));
  if (!options.true_peaks) return columns;
  columns.resize(6);
  for (const TrueSpectrumPoint& point : true_response_spectrum(
           signal.acceleration, signal.time_step, options.frequencies, ratio, after_record)) {
    columns[3].push_back(point.velocity);
    columns[4].push_back(point.absolute_acceleration);
    columns[5].push_back(point.relative_acceleration);
  }
  return columns;
}

std::vector<Spectrum> spectra_of(const SpectraOptions& options, const Input& input) {
  std::vector<Spectrum> spectra;
  for (const Treatment treatment : options.treatments) {
    const SampledSignal treated =
        treat(input.named.signal, input.peaks, treatment, input.dirac_step);
    for (const double ratio : options.damping_ratios) {
      spectra.push_back({source_of(input.named), treatment, ratio,
                         compute(options, treated, ratio, after(options, input, treatment))});
    }
  }
  return spectra;
}

/// Spectra of a pair of components over all horizontal directions.
std::vector<Spectrum> spectra_of_pair(const SpectraOptions& options, const Input& first,
                                      const Input& second) {
  const SampledSignal& one = first.named.signal;
  const SampledSignal& other = second.named.signal;
  refuse_if(one.time_step != other.time_step || one.first_time != other.first_time ||
                one.acceleration.size() != other.acceleration.size(),
            "--rotd: " + first.named.name + " and " + second.named.name +
                " have other times: they are no pair");
  const auto all = rotated_spectra(one.acceleration, other.acceleration, one.time_step,
                                   options.frequencies, options.damping_ratios, options.rotated,
                                   after(options, first, Treatment::complete));
  const std::string source = source_of(first.named);
  const std::string probe = first.named.is_history
                                ? source.substr(0, source.rfind(',') + 1)
                                : first.named.name + " " + second.named.name + ",";
  std::vector<Spectrum> spectra;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::size_t percentiles = options.rotated.size();
    spectra.push_back({probe + sentence("rotd{:02.10g}", {options.rotated[k % percentiles]}),
                       Treatment::complete, options.damping_ratios[k / percentiles],
                       columns_of(all[k])});
  }
  return spectra;
}

/// The pairs among the inputs: x and y of a probe, or one record after the other.
std::vector<std::pair<const Input*, const Input*>> pairs_of(const std::vector<Input>& inputs) {
  std::vector<std::pair<const Input*, const Input*>> pairs;
  std::vector<const Input*> records;
  for (const Input& input : inputs) {
    if (!input.named.is_history) {
      records.push_back(&input);
      continue;
    }
    if (!input.named.name.ends_with(".x")) continue;
    std::string partner = input.named.name;
    partner.back() = 'y';
    const auto found = std::ranges::find_if(inputs, [&](const Input& other) {
      return other.named.name == partner && other.named.folder == input.named.folder;
    });
    if (found != inputs.end()) pairs.emplace_back(&input, &*found);
  }
  refuse_if(records.size() % 2 != 0,
            "--rotd: " + std::to_string(records.size()) +
                " components of records are no pairs; give two columns or two files");
  for (std::size_t i = 0; i + 1 < records.size(); i += 2) {
    pairs.emplace_back(records[i], records[i + 1]);
  }
  if (pairs.empty()) throw UserError("--rotd: no probe has both x and y among the channels");
  return pairs;
}

/// Takes the spectra of one more channel, in the same order, into the envelope.
void widen(std::vector<Spectrum>& envelope, const std::vector<Spectrum>& spectra) {
  for (std::size_t i = 0; i < envelope.size(); ++i) {
    for (std::size_t q = 0; q < envelope[i].columns.size(); ++q) {
      envelope[i].columns[q] =
          envelope_of(std::vector{envelope[i].columns[q], spectra[i].columns[q]});
    }
  }
}

/// Rows of spectra, one per frequency. `interval` [s]: longest one between samples.
void write_spectra(CsvFile& file, const SpectraOptions& options,
                   const std::vector<Spectrum>& spectra, double interval) {
  constexpr std::size_t pseudo = 3;
  for (const Spectrum& spectrum : spectra) {
    std::vector<std::vector<double>> columns;
    for (const auto& values : spectrum.columns) {
      columns.push_back(broadened(options.frequencies, values, options.broadening));
    }
    const std::string label =
        spectrum.source + "," + treatment_names()[static_cast<std::size_t>(spectrum.treatment)];
    std::vector<double> row;
    for (std::size_t i = 0; i < options.frequencies.size(); ++i) {
      row = {spectrum.damping_ratio, options.frequencies[i], 1 / options.frequencies[i]};
      for (std::size_t q = 0; q < pseudo; ++q) row.push_back(columns[q][i]);
      row.insert(row.end(),
                 {interval, faithful_up_to(interval), options.start, options.broadening});
      for (std::size_t q = pseudo; q < columns.size(); ++q) row.push_back(columns[q][i]);
      file.row(label, row);
    }
  }
}

/// Nothing but an earlier table gives way to a new one, and never an input of this job.
void require_free_place(const SpectraOptions& options, const std::string& option,
                        const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code failure;
  if (path.empty() || !fs::is_regular_file(path, failure)) return;
  const auto refuse = [&](const std::string& why) {
    throw UserError(option + " " + path + ": " + why + "; give another file");
  };
  std::vector<std::string> inputs = options.files;
  inputs.push_back(options.impacts);
  for (const std::string& input : inputs) {
    if (fs::equivalent(path, input, failure)) refuse("the program reads that file");
  }
  std::ifstream file(path, std::ios::binary);
  std::string line;
  while (std::getline(file, line) && line.starts_with('#')) {
  }
  if (!line.empty() && !line.starts_with("probe,direction,")) {
    refuse("there is a file of that name that is no table of spectra or peaks");
  }
}

void write_samples(const std::string& path, int digits, const std::vector<Input>& inputs) {
  CsvFile file(path, digits);
  file.header("probe,direction,time,acceleration");
  for (const Input& input : inputs) {
    const SampledSignal& signal = input.named.signal;
    for (std::size_t i = 0; i < signal.acceleration.size(); ++i) {
      file.row(
          source_of(input.named),
          {signal.first_time + static_cast<double>(i) * signal.time_step, signal.acceleration[i]});
    }
  }
  file.close();
}

void write_peaks(CsvFile& file, const Input& input) {
  const SampledSignal& signal = input.named.signal;
  const auto start_of = [&](std::size_t k) {
    return signal.first_time + (static_cast<double>(k) - 0.5) * signal.time_step;
  };
  for (const SignalPeak& peak : input.peaks) {
    file.row(source_of(input.named), {start_of(peak.first), start_of(peak.last), peak.impulse,
                                      &peak == &highest_peak(input.peaks) ? 1.0 : 0.0});
  }
}

}  // namespace

void run_spectra(const SpectraOptions& options) {
  require_free_place(options, "--output", options.output == "/dev/stdout" ? "" : options.output);
  require_free_place(options, "--peaks", options.peaks == "/dev/stdout" ? "" : options.peaks);
  require_free_place(options, "--samples", options.samples == "/dev/stdout" ? "" : options.samples);
  std::vector<Input> inputs;
  double longest_step = 0;
  for (NamedSignal& named : read_signals(options)) {
    longest_step = std::max(longest_step, named.signal.time_step);
    inputs.push_back(prepare(options, std::move(named)));
  }
  if (!options.samples.empty()) write_samples(options.samples, options.digits, inputs);
  CsvFile file(options.output, options.digits);
  std::optional<CsvFile> peaks;
  if (!options.peaks.empty()) {
    peaks.emplace(options.peaks, options.digits);
    peaks->header("probe,direction,start,end,impulse,highest");
  }
  file.header(std::string(spectrum_columns) +
              (options.true_peaks ? ",velocity,absolute_acceleration,relative_acceleration" : ""));
  std::vector<Spectrum> envelope;
  const auto take = [&](std::vector<Spectrum> spectra, double interval) {
    if (!options.envelope) {
      write_spectra(file, options, spectra, interval);
    } else if (envelope.empty()) {
      envelope = std::move(spectra);
    } else {
      widen(envelope, spectra);
    }
  };
  if (!options.rotated.empty()) {
    for (const auto& [first, second] : pairs_of(inputs)) {
      take(spectra_of_pair(options, *first, *second), first->named.signal.time_step);
    }
  } else {
    for (const Input& input : inputs) {
      take(spectra_of(options, input), input.named.signal.time_step);
      if (peaks) write_peaks(*peaks, input);
    }
  }
  for (Spectrum& spectrum : envelope) {
    const std::string direction = spectrum.source.substr(spectrum.source.rfind(','));
    spectrum.source = "envelope" + (options.rotated.empty() ? "," : direction);
  }
  write_spectra(file, options, envelope, longest_step);
  if (peaks) peaks->close();
  file.close();
}

}  // namespace pounding
