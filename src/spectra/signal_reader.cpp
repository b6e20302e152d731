#include "spectra/signal_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "common/byte_texts.h"
#include "common/error.h"
#include "io/csv_file.h"
#include "io/hdf5_reader.h"
#include "io/schema.h"
#include "motion/accelerogram.h"
#include "scene/option_values.h"

namespace pounding {

namespace {

bool is_history(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension();
  return extension == ".h5" || extension == ".hdf5";
}

std::string folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

/// Places in `channels` of a channel, or of a probe's three directions.
std::vector<std::size_t> choose(const std::string& path, const std::vector<std::string>& channels,
                                const std::vector<std::string>& asked) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; asked.empty() && i < channels.size(); ++i) chosen.push_back(i);
  for (const std::string& name : asked) {
    const std::size_t before = chosen.size();
    for (std::size_t i = 0; i < channels.size(); ++i) {
      const bool of_probe = channels[i].substr(0, channels[i].rfind('.')) == name;
      if (of_probe || channels[i] == name) chosen.push_back(i);
    }
    if (chosen.size() == before) {
      throw UserError(path + ": there is no channel or probe '" + name + "'" +
                      suggestion(name, channels));
    }
  }
  if (chosen.empty()) throw UserError(path + ": no channel is recorded");
  return chosen;
}

/// Sampling step of the records, which a run makes uniform.
double uniform_step(const std::string& path, const std::vector<double>& time) {
  refuse_if(time.size() < 2, path + ": holds " + std::to_string(time.size()) +
                                 " records; a spectrum needs at least 2");
  const double step = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  for (std::size_t i = 1; i < time.size(); ++i) {
    if (!(std::abs(time[i] - time[i - 1] - step) < 1e-6 * step)) {
      throw UserError(path + ": the records are not evenly spaced at " + std::to_string(time[i]) +
                      " s");
    }
  }
  return step;
}

std::vector<double> less_ground(const Hdf5Reader& history, const std::string& path,
                                std::vector<double> acceleration, const std::string& channel) {
  const std::string direction = channel.substr(channel.rfind('.') + 1);
  const auto place = std::ranges::find(direction_names, direction) - direction_names.begin();
  refuse_if(place == static_cast<std::ptrdiff_t>(direction_names.size()),
            path + ": channel '" + channel + "' has no direction x, y or z");
  refuse_if(history.shape("ground_acceleration").columns != direction_names.size(),
            path + ": ground_acceleration has no three columns");
  const auto ground = history.rows("ground_acceleration", 0, acceleration.size());
  for (std::size_t i = 0; i < acceleration.size(); ++i) {
    acceleration[i] -= ground.at(3 * i + static_cast<std::size_t>(place));
  }
  return acceleration;
}

/// Rows that are whole, all of them in a file that does not say: rows behind them were still being
/// written when its run ended.
std::size_t whole_records(const Hdf5Reader& history, const std::string& path) {
  const std::size_t rows = history.shape("time").rows;
  const std::vector<std::string> names = history.names("/");
  if (std::ranges::find(names, "records") == names.end()) return rows;
  const double whole = history.rows("records", 0, 1)[0];
  refuse_if(!(whole >= 0 && whole <= static_cast<double>(rows)),
            path + ": 'records' is not a number of its " + std::to_string(rows) + " rows");
  return static_cast<std::size_t>(whole);
}

void require_schema(const std::string& path, const Hdf5Reader& history) {
  try {
    schema::require(history, schema::history);
  } catch (const std::runtime_error& error) {
    throw UserError(path + ": a history " + error.what() + "; make the run anew");
  }
}

void read_history(const std::string& path, const SpectraOptions& options,
                  std::vector<NamedSignal>& signals) {
  const Hdf5Reader history(path, Hdf5Reader::Kind::left_open);
  require_schema(path, history);
  const auto channels = history.strings("channels");
  const std::size_t records = whole_records(history, path);
  const auto time = history.rows("time", 0, records);
  const double step = uniform_step(path, time);
  const double offset = history.number("acceleration", "time_offset");
  const auto shape = history.shape("acceleration");
  refuse_if(shape.columns != channels.size() || shape.rows < records,
            path + ": acceleration, time and channels do not fit together");
  const auto all = history.rows("acceleration", 0, records);
  for (const std::size_t channel : choose(path, channels, options.channels)) {
    std::vector<double> acceleration;
    acceleration.reserve(records);
    for (std::size_t row = 0; row < records; ++row) {
      acceleration.push_back(all[row * shape.columns + channel]);
    }
    if (options.relative) {
      acceleration = less_ground(history, path, std::move(acceleration), channels[channel]);
    }
    signals.push_back({channels[channel],
                       {std::move(acceleration), step, time.front() + offset},
                       folder_of(path),
                       true});
  }
}

void read_record(const std::string& path, const SpectraOptions& options,
                 std::vector<NamedSignal>& signals) {
  refuse_if(!options.channels.empty() || options.relative,
            path + " is a record: --channels and --frame go with the history.h5 of a run");
  for (const int column : options.columns) {
    Accelerogram record = read_accelerogram({path, options.unit, options.time_step, column});
    for (const std::string& doubt : record.doubts) {
      std::fprintf(stderr, "pounding-spectra: warning: %s\n", one_line(doubt).c_str());
    }
    const std::string name = column == 0 ? std::filesystem::path(path).stem().string()
                                         : "column" + std::to_string(column);
    NamedSignal& signal = signals.emplace_back();
    signal.name = name;
    signal.folder = folder_of(path);
    signal.signal.acceleration = std::move(record.acceleration);
    signal.signal.time_step = record.time_step;
    signal.signal.first_time = record.start;
  }
}

/// Takes the samples away whose middle comes before `start` [s].
void begin_at(double start, NamedSignal& named) {
  SampledSignal& signal = named.signal;
  const double before = std::ceil((start - signal.first_time) / signal.time_step - 1e-6);
  if (start == 0 || before <= 0) return;
  refuse_if(
      before > static_cast<double>(signal.acceleration.size()) - 2,
      named.name + ": ends before two samples are left after --start " + std::to_string(start));
  signal.acceleration.erase(signal.acceleration.begin(),
                            signal.acceleration.begin() + static_cast<std::ptrdiff_t>(before));
  signal.first_time += before * signal.time_step;
}

}  // namespace

std::vector<NamedSignal> read_signals(const SpectraOptions& options) {
  std::vector<NamedSignal> signals;
  for (const std::string& file : options.files) {
    const std::size_t first = signals.size();
    if (is_history(file)) {
      read_history(file, options, signals);
    } else {
      read_record(file, options, signals);
    }
    for (std::size_t i = first; options.files.size() > 1 && i < signals.size(); ++i) {
      signals[i].name = file + ":" + signals[i].name;
    }
  }
  for (NamedSignal& signal : signals) {
    signal.name = plain_cell(one_line(signal.name));
    std::ranges::replace(signal.name, ',', '_');
    begin_at(options.start, signal);
  }
  return signals;
}

}  // namespace pounding
