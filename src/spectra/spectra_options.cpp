#include "spectra/spectra_options.h"

#include <algorithm>
#include <array>

#include "common/error.h"
#include "motion/spectrum_shape.h"
#include "scene/nearest_name.h"
#include "scene/option_values.h"

namespace pounding {

namespace {

/// One option: how its value is read into the struct, and its lines of help.
struct OptionSpec {
  const char* name;
  const char* value;  ///< "" for a flag
  const char* expected;
  const char* help;
  /// False when the text is not of the expected kind.
  bool (*read)(const std::string& text, SpectraOptions& options);
};

bool read_number(const std::string& text, double low, double high, double& target) {
  const auto number = parse_real(text);
  if (!number || *number < low || *number > high) return false;
  target = *number;
  return true;
}

bool read_names(const std::string& text, std::vector<std::string>& target) {
  target = split(text, ',');
  return std::ranges::none_of(target, &std::string::empty);
}

bool read_choice(const std::string& text, std::initializer_list<const char*> choices,
                 std::string& target) {
  target = text;
  return std::ranges::find(choices, text) != choices.end();
}

bool read_columns(const std::string& text, SpectraOptions& options) {
  options.columns.clear();
  for (const std::string& word : split(text, ',')) {
    const auto column = parse_integer(word);
    if (!column || *column < 1) return false;
    options.columns.push_back(*column);
  }
  return true;
}

bool read_damping(const std::string& text, SpectraOptions& options) {
  const auto ratios = parse_reals(text);
  if (!ratios || std::ranges::any_of(*ratios, [](double r) { return r < 0 || r >= 1; })) {
    return false;
  }
  options.damping_ratios = *ratios;
  return true;
}

bool read_percentiles(const std::string& text, SpectraOptions& options) {
  const auto percentiles = parse_reals(text);
  if (!percentiles ||
      std::ranges::any_of(*percentiles, [](double p) { return p < 0 || p > 100; })) {
    return false;
  }
  options.rotated = *percentiles;
  return true;
}

bool read_frequencies(const std::string& text, SpectraOptions& options) {
  if (text == "regulatory") {
    options.frequencies = regulatory_frequencies();
    return true;
  }
  const auto frequencies = parse_increasing(text);
  if (!frequencies || frequencies->front() <= 0) return false;
  options.frequencies = *frequencies;
  return true;
}

bool read_treatments(const std::string& text, SpectraOptions& options) {
  const auto names = treatment_names();
  options.treatments.clear();
  for (const std::string& word : split(text, ',')) {
    const auto found = std::ranges::find(names, word);
    if (word == "all") {
      for (std::size_t i = 0; i < names.size(); ++i) {
        options.treatments.push_back(static_cast<Treatment>(i));
      }
    } else if (found == names.end()) {
      return false;
    } else {
      options.treatments.push_back(static_cast<Treatment>(found - names.begin()));
    }
  }
  return true;
}

bool read_unit(const std::string& text, SpectraOptions& options) {
  return read_choice(text, {"g", "m/s2", "cm/s2", "mm/s2"}, options.unit);
}

bool read_frame(const std::string& text, SpectraOptions& options) {
  options.relative = text == "relative";
  return options.relative || text == "absolute";
}

constexpr double no_limit = 1e300;
constexpr double tiny = 1e-300;

constexpr std::array option_specs{
    OptionSpec{"channels", "NAMES", "probes or probe.direction, separated by commas",
               "history: which channels, as s2_floor2.x, or s2_floor2 for its\n"
               "three directions; all without this option",
               [](const std::string& t, SpectraOptions& o) { return read_names(t, o.channels); }},
    OptionSpec{"frame", "absolute|relative", "absolute or relative",
               "history: the absolute acceleration (default), or less that of\n"
               "the ground",
               read_frame},
    OptionSpec{"columns", "N,...", "column numbers from 1",
               "record: which columns, counted from 1; needed where there are more\n"
               "than the time and one other",
               read_columns},
    OptionSpec{"unit", "g|m/s2|cm/s2|mm/s2", "g, m/s2, cm/s2 or mm/s2",
               "record: its unit, when its header does not say it", read_unit},
    OptionSpec{"time-step", "S", "a number above 0",
               "record: its time step [s], when the file does not say it",
               [](const std::string& t, SpectraOptions& o) {
                 return read_number(t, tiny, no_limit, o.time_step);
               }},
    OptionSpec{"start", "S", "a number above 0", "begin there, with oscillators at rest [s]",
               [](const std::string& t, SpectraOptions& o) {
                 return read_number(t, tiny, no_limit, o.start);
               }},
    OptionSpec{"damping", "RATIO,...", "ratios from 0, below 1", "damping ratios; default 0.05",
               read_damping},
    OptionSpec{"frequencies", "LIST",
               "regulatory, START:STOP:COUNTlog, START:STOP:COUNTlin or f1,f2,..., increasing, "
               "above 0",
               "frequencies [Hz]: START:STOP:COUNTlog (default 0.5:400:200log),\n"
               "...lin, f1,f2,..., or regulatory: the 75 from 0.2 to 34 Hz of\n"
               "U.S. NRC Regulatory Guide 1.122",
               read_frequencies},
    OptionSpec{"true", "", "no value",
               "also the true peaks: relative velocity, absolute and relative\n"
               "acceleration",
               [](const std::string&, SpectraOptions& o) { return o.true_peaks = true; }},
    OptionSpec{"after", "auto|free_vibration|ignored", "auto, free_vibration or ignored",
               "whether the free vibration after the last sample counts; auto:\n"
               "it does for a record, not for a history, which is cut short",
               [](const std::string& t, SpectraOptions& o) {
                 return read_choice(t, {"auto", "free_vibration", "ignored"}, o.after);
               }},
    OptionSpec{"envelope", "", "no value", "the envelope of all channels instead of each",
               [](const std::string&, SpectraOptions& o) { return o.envelope = true; }},
    OptionSpec{"rotd", "PERCENT,...", "numbers from 0 to 100",
               "percentiles over all horizontal directions of a pair of components\n"
               "instead of each: 50 (RotD50), 100 (RotD100); of a history x and y of\n"
               "every probe, of records two columns or files",
               read_percentiles},
    OptionSpec{"broaden", "PERCENT", "a number from 0, below 100",
               "widen every peak by so much to both sides (15 in Regulatory\n"
               "Guide 1.122)",
               [](const std::string& t, SpectraOptions& o) {
                 if (!read_number(t, 0, 99.999, o.broadening)) return false;
                 o.broadening /= 100;
                 return true;
               }},
    OptionSpec{"treatment", "NAMES",
               "complete, all_peaks, highest_peak, without_peaks, dirac or all",
               "part of a signal with impacts that is kept, one or more of:\n"
               "  complete       everything (default)\n"
               "  all_peaks      the samples during contacts, zero between them\n"
               "  highest_peak   of these the one with the largest impulse\n"
               "  without_peaks  everything but the peaks\n"
               "  dirac          a triangle of this impulse, its base two time steps\n"
               "  all            the five of them",
               read_treatments},
    OptionSpec{"impacts", "FILE", "a file",
               "when the bodies touch: impacts.csv of the run; default: the one\n"
               "beside FILE",
               [](const std::string& t, SpectraOptions& o) { return !(o.impacts = t).empty(); }},
    OptionSpec{"contacts", "NAMES", "names separated by commas",
               "whose impacts make the peaks; all without this option",
               [](const std::string& t, SpectraOptions& o) { return read_names(t, o.contacts); }},
    OptionSpec{"margin", "S", "a number, 0 or more",
               "time added to a contact on both sides [s]; default 0",
               [](const std::string& t, SpectraOptions& o) {
                 return read_number(t, 0, no_limit, o.margin);
               }},
    OptionSpec{"dirac-step", "S", "a number above 0",
               "half the base of the triangle [s]; default: the time step in\n"
               "summary.json of the run, beside FILE",
               [](const std::string& t, SpectraOptions& o) {
                 return read_number(t, tiny, no_limit, o.dirac_step);
               }},
    OptionSpec{"output", "FILE", "a file", "CSV of the spectra; default: standard output",
               [](const std::string& t, SpectraOptions& o) { return !(o.output = t).empty(); }},
    OptionSpec{"peaks", "FILE", "a file",
               "CSV of the peaks: start, end, impulse of the floor per unit of mass",
               [](const std::string& t, SpectraOptions& o) { return !(o.peaks = t).empty(); }},
    OptionSpec{"digits", "N", "a whole number from 6 to 17",
               "significant digits of every number; default 9, 17: to the bit",
               [](const std::string& t, SpectraOptions& o) {
                 const auto number = parse_integer(t);
                 o.digits = number.value_or(0);
                 return o.digits >= 6 && o.digits <= 17;
               }},
};

const OptionSpec& find_option(const std::string& name) {
  const auto found = std::ranges::find(option_specs, name, &OptionSpec::name);
  if (found != option_specs.end()) return *found;
  std::vector<std::string> names{"help"};
  for (const OptionSpec& spec : option_specs) names.emplace_back(spec.name);
  throw UserError("unknown option --" + name + suggestion(name, names) + " (see --help)");
}

void check_together(const SpectraOptions& options) {
  if (options.files.empty()) throw UserError("no file given (see --help)");
  const bool peaks =
      !options.peaks.empty() || std::ranges::any_of(options.treatments, [](Treatment treatment) {
        return treatment != Treatment::complete;
      });
  if (!peaks && (!options.impacts.empty() || !options.contacts.empty() || options.margin > 0 ||
                 options.dirac_step > 0)) {
    throw UserError(
        "--impacts, --contacts, --margin and --dirac-step have no effect without --treatment or "
        "--peaks");
  }
  if (!options.rotated.empty() && (options.true_peaks || peaks)) {
    throw UserError(
        "--rotd has pseudo peaks of complete signals: not with --true, --treatment, "
        "--peaks");
  }
  const auto place = [](const std::string& file) {
    return file.empty() ? std::string("/dev/stdout") : file;
  };
  if (!options.peaks.empty() && options.peaks == place(options.output)) {
    throw UserError("--peaks " + options.peaks + ": the spectra go there; give another file");
  }
}

}  // namespace

std::string spectra_help() {
  std::string text =
      "pounding-spectra: response spectra of recorded or computed accelerations\n\n"
      "  pounding-spectra [--name value ...] FILE ...\n\n"
      "FILE is the history.h5 of a run, or a record: AT2, CSV, columns, CSMIP rows, JSON. The\n"
      "oscillators start at rest, and their peaks are exact for samples joined by lines. A CSV\n"
      "as spectra.csv of a run is; SI units.\n\n";
  for (const OptionSpec& spec : option_specs) {
    std::string line = "  --" + std::string(spec.name) + " " + spec.value;
    if (line.size() > 26) {
      text += line + "\n";
      line.clear();
    }
    line.resize(28, ' ');
    for (const std::string& part : split(spec.help, '\n')) {
      text += line + part + "\n";
      line.assign(28, ' ');
    }
  }
  return text + "  --help                    this page\n\nExit status: 0, or 1 after an error.\n";
}

SpectraOptions read_spectra_options(std::span<const std::string> words) {
  SpectraOptions options;
  options.after = "auto";
  read_frequencies("0.5:400:200log", options);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (!words[i].starts_with("-") || words[i] == "-") {
      options.files.push_back(words[i]);
      continue;
    }
    std::string name = words[i].substr(words[i].starts_with("--") ? 2 : 1);
    const std::size_t equals = name.find('=');
    const bool joined = equals != std::string::npos;
    std::string value = joined ? name.substr(equals + 1) : "";
    if (joined) name.resize(equals);
    const OptionSpec& spec = find_option(name);
    if (*spec.value != '\0' && !joined) {
      if (i + 1 == words.size()) throw UserError("--" + name + " needs a value: " + spec.expected);
      value = words[++i];
    }
    if ((*spec.value == '\0' && joined) || !spec.read(trimmed(value), options)) {
      throw UserError("--" + name + " '" + shown_value(value) + "': " + spec.expected +
                      " expected");
    }
  }
  check_together(options);
  return options;
}

}  // namespace pounding
