#include "spectra/spectra_options.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "motion/spectrum_shape.h"
#include "scene/option_reader.h"
#include "scene/option_values.h"

namespace pounding {

namespace {

const OptionRow& row_of(const std::string& name) {
  std::vector<std::string> names{"help"};
  for (const OptionRow& row : spectra_option_table()) {
    if (row.pattern.substr(1) == name) return row;
    names.emplace_back(row.pattern.substr(1));
  }
  throw UserError("unknown option --" + name + suggestion(name, names) + " (see --help)");
}

/// Options among the words of the command line, by their patterns, and in `files` all else.
OptionsDatabase sort_words(std::span<const std::string> words, std::vector<std::string>& files) {
  OptionsDatabase database;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (!words[i].starts_with("-") || words[i] == "-") {
      files.push_back(words[i]);
      continue;
    }
    const std::string word = words[i].substr(words[i].starts_with("--") ? 2 : 1);
    const std::size_t equals = word.find('=');
    const bool joined = equals != std::string::npos;
    const std::string name = word.substr(0, equals);
    const OptionRow& row = row_of(name);
    std::string& value = database[std::string(row.pattern)];
    if (row.kind == OptionKind::boolean) {
      if (joined) throw UserError("option --" + shown_value(word) + ": expected no value");
    } else if (joined) {
      value = word.substr(equals + 1);
    } else if (i + 1 == words.size()) {
      throw UserError("option --" + name + " needs a value: expected " + expected_text(row));
    } else {
      value = words[++i];
    }
  }
  return database;
}

/// Numbers of columns; 0 for the only one beside the time.
std::vector<int> read_columns(OptionReader& reader) {
  if (!reader.given("-columns")) return {0};
  std::vector<int> columns;
  for (const double number : reader.reals("-columns")) {
    if (number != std::floor(number) || number > 1e6) {
      reader.refuse("-columns", {}, "not whole numbers up to a million");
    }
    columns.push_back(static_cast<int>(number));
  }
  return columns;
}

std::vector<double> read_frequencies(OptionReader& reader) {
  const std::string text = reader.text("-frequencies");
  if (text == "regulatory") return regulatory_frequencies();
  const auto frequencies = parse_increasing(text);
  if (!frequencies || frequencies->front() <= 0) reader.refuse("-frequencies", {});
  if (!are_of_oscillators(*frequencies)) {
    reader.refuse("-frequencies", {}, "not between 1e-6 and 1e6 Hz");
  }
  return *frequencies;
}

std::vector<Treatment> read_treatments(OptionReader& reader) {
  const auto names = treatment_names();
  std::vector<Treatment> treatments;
  for (const std::string& word : split(reader.text("-treatment"), ',')) {
    if (word != "all" && std::ranges::find(names, word) == names.end()) {
      reader.refuse("-treatment", {});
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (word == "all" || word == names[i]) treatments.push_back(static_cast<Treatment>(i));
    }
  }
  return treatments;
}

/// Refuses options that have no effect with --accept, or none without it.
void check_acceptance(const OptionReader& reader, bool accept) {
  const std::string_view idle = accept
                                    ? "-damping -frequencies -true -after -envelope -rotd -broaden "
                                      "-treatment -peaks -samples -digits"
                                    : "-anchor -directions";
  for (const std::string& pattern : split(idle, ' ')) {
    if (!reader.given(pattern)) continue;
    throw UserError("-" + pattern + " has no effect with" +
                    (accept ? " --accept: the table of rules decides" : "out --accept"));
  }
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
  refuse_if(!options.rotated.empty() && (options.true_peaks || peaks),

            "--rotd has pseudo peaks of complete signals: not with --true, --treatment, --peaks");
  const auto place = [](const std::string& file) {
    return file.empty() ? std::string("/dev/stdout") : file;
  };
  for (const auto& [name, file] :
       {std::pair{"--peaks ", options.peaks}, {"--samples ", options.samples}}) {
    refuse_if(!file.empty() && file == place(options.output),
              name + file + ": the spectra go there; give another file");
  }
}

/// Lines of the help on an option.
std::string lines_of(const OptionRow& row) {
  constexpr std::size_t indent = 28;
  constexpr std::size_t width = 68;
  std::string line = "  -" + std::string(row.pattern) + " ";
  std::string help(row.help);
  if (row.kind != OptionKind::boolean) {
    line += row.kind == OptionKind::choice ? std::string(row.form) : upper_case(row.unit);
    if (row.kind == OptionKind::reals) line += ",...";
    help.append(help.ends_with('\n') ? "" : "; ").append(row.preset.has_value ? "default: " : "");
    help.append(row.preset.text);
  }
  if (const std::string range = row.range.text(); range != "any") {
    help.append(range[0] == '>' ? "; " : "; in ").append(range);
  }
  std::string text;
  if (line.size() > indent - 2) {
    text = line + "\n";
    line.clear();
  }
  for (std::string part : split(help, '\n')) {
    while (!part.empty()) {
      line.resize(indent, ' ');
      const std::size_t end = part.size() > width ? part.rfind(' ', width) : part.size();
      text += line + part.substr(0, end) + "\n";
      part = trimmed(part.substr(end));
      line.clear();
    }
  }
  return text;
}

}  // namespace

std::string spectra_help() {
  std::string text =
      "pounding-spectra: response spectra of recorded or computed accelerations\n\n"
      "  pounding-spectra [--name value ...] FILE ...\n\n"
      "FILE is the history.h5 of a run, or a record: AT2, CSV, columns, CSMIP rows, JSON. The\n"
      "oscillators start at rest, and their peaks are exact for samples joined by lines. A CSV\n"
      "as spectra.csv of a run is; SI units.\n\n";
  for (const OptionRow& row : spectra_option_table()) text += lines_of(row);
  return text +
         "  --help                    this page\n\nExit status: 0, or 1 after an error; "
         "with --accept 3 when a rule refuses a motion.\n";
}

SpectraOptions read_spectra_options(std::span<const std::string> words) {
  SpectraOptions options;
  const OptionsDatabase database = sort_words(words, options.files);
  OptionReader reader(database);
  const auto text = [&](const char* pattern) {
    return reader.given(pattern) ? reader.text(pattern) : "";
  };
  const auto real = [&](const char* pattern) {
    return reader.given(pattern) ? reader.real(pattern) : 0;
  };
  options.channels = reader.list("-channels");
  options.columns = read_columns(reader);
  if (reader.given("-unit")) options.unit = reader.choice("-unit");
  options.time_step = real("-time-step");
  options.relative = reader.choice("-frame") == "relative";
  options.start = reader.real("-start");
  options.damping_ratios = reader.reals("-damping");
  options.frequencies = read_frequencies(reader);
  options.true_peaks = reader.boolean("-true");
  options.envelope = reader.boolean("-envelope");
  if (reader.given("-rotd")) options.rotated = reader.reals("-rotd");
  options.broadening = reader.real("-broaden") / 100;
  options.after = reader.choice("-after");
  options.treatments = read_treatments(reader);
  options.impacts = text("-impacts");
  options.contacts = reader.list("-contacts");
  options.margin = reader.real("-margin");
  options.dirac_step = real("-dirac-step");
  options.output = text("-output");
  options.peaks = text("-peaks");
  options.samples = text("-samples");
  options.rules = text("-accept");
  options.digits = reader.integer("-digits");
  check_acceptance(reader, !options.rules.empty());
  check_together(options);
  return options;
}

}  // namespace pounding
