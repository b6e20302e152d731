#include "scene/fidelity_target.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "common/finite_file.h"
#include "scene/option_reader.h"
#include "scene/option_values.h"

namespace pounding {
namespace {

struct Setting {
  std::string name;
  double rms = 0;   ///< of ln(spectrum / full order), worst case [-]
  double cost = 0;  ///< wall time over motion [s/s]
  std::vector<std::pair<std::string, std::string>> options;  ///< "-name" for the run, else "name"
};

Setting parse_setting(const std::string& line, const std::string& where) {
  const std::vector<std::string> cells = split(line, ',');
  Setting setting;
  const std::optional<double> rms = cells.size() == 4 ? parse_real(cells[1]) : std::nullopt;
  const std::optional<double> cost = cells.size() == 4 ? parse_real(cells[2]) : std::nullopt;
  if (!rms || !cost || *rms < 0 || *cost <= 0) {
    throw UserError(where + ": expected setting,rms,cost,options");
  }
  setting = {cells[0], *rms, *cost, {}};
  std::istringstream words(cells[3]);
  for (std::string word; words >> word;) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw UserError(where + ": '" + word + "' is not name=value");
    }
    setting.options.emplace_back(word.substr(0, equals), word.substr(equals + 1));
  }
  return setting;
}

/// Results of a fidelity study, and the structures that it was made on.
struct SettingTable {
  std::string structures_key;  ///< empty if the file does not say it
  std::string structures;      ///< in words
  std::vector<Setting> settings;
};

SettingTable read_table(const std::string& path) {
  constexpr std::string_view key = "# structures: ";
  require_finite_file(path, "option -fidelity_table ");
  std::ifstream file(path);
  if (!file) {
    throw UserError(
        "option -fidelity_table " + path +
        ": no such file; run/tradeoff (pounding-tools tradeoff) writes one, fidelity.csv");
  }
  SettingTable table;
  std::vector<Setting>& settings = table.settings;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (line.starts_with(key)) {
      std::istringstream words(line.substr(key.size()));
      words >> table.structures_key >> std::ws;
      std::getline(words, table.structures);
    }
    if (!line.empty() && line[0] != '#' && !line.starts_with("setting,")) {
      settings.push_back(parse_setting(line, path + ", line " + std::to_string(number)));
    }
  }
  return table;
}

/// Errors measured on other structures say nothing of these.
void require_same_structures(const SettingTable& table, const std::string& path,
                             const std::string& structures_key) {
  if (table.structures_key.empty()) {
    throw UserError("option -fidelity_table " + path +
                    ": does not say on which structures it was measured; let run/tradeoff "
                    "(pounding-tools tradeoff) write it, or add a line '# structures: KEY' with "
                    "structures_key of the summary.json "
                    "of that study");
  }
  if (table.structures_key != structures_key) {
    throw UserError("option -fidelity_target: the errors in " + path +
                    " were measured on other structures (" + table.structures + "; key " +
                    table.structures_key + ", of this scene " + structures_key +
                    "); nothing is known of these: leave the target out, or measure them as "
                    "docs/fidelity.md says");
  }
}

/// The options of the scene that a setting means.
std::vector<std::pair<std::string, std::string>> options_of(
    const Setting& setting, const std::vector<std::string>& structures) {
  std::vector<std::pair<std::string, std::string>> options;
  for (const auto& [name, value] : setting.options) {
    if (name[0] == '-') {
      options.emplace_back(name.substr(1), value);
      continue;
    }
    for (const std::string& structure : structures) {
      options.emplace_back(structure + "_" + name, value);
    }
  }
  return options;
}

bool same(const std::string& a, const std::string& b) {
  const std::optional<double> x = parse_real(a);
  const std::optional<double> y = parse_real(b);
  return a == b || (x && y && *x == *y);
}

/// Whether the user gave none of the options of a setting another value: its error was measured
/// with all of them.
bool agrees(const Setting& setting, const OptionsDatabase& given,
            const std::vector<std::string>& structures) {
  return std::ranges::all_of(options_of(setting, structures), [&](const auto& option) {
    const auto found = given.find(option.first);
    return found == given.end() || same(found->second, option.second);
  });
}

const Setting& fastest(const std::vector<Setting>& settings, double target,
                       const OptionsDatabase& given, const std::vector<std::string>& structures,
                       const std::string& path) {
  const Setting* best = nullptr;
  for (const Setting& setting : settings) {
    if (setting.rms <= target && agrees(setting, given, structures) &&
        (best == nullptr || setting.cost < best->cost)) {
      best = &setting;
    }
  }
  if (best == nullptr) {
    std::ostringstream text;
    text << "option -fidelity_target " << target << ": no setting in " << path
         << " is that accurate and agrees with the options given; leave the target out for full "
            "order";
    throw UserError(text.str());
  }
  return *best;
}

}  // namespace

ChosenFidelity choose_fidelity(const OptionsDatabase& given, const std::string& structures_key) {
  ChosenFidelity chosen{given, ""};
  OptionReader reader(given);
  if (!reader.given("fidelity_target")) return chosen;
  const double target = reader.real("fidelity_target");
  const std::string path = reader.text("fidelity_table");
  const SettingTable table = read_table(path);
  require_same_structures(table, path, structures_key);
  const std::vector<std::string> structures = reader.list("structures");
  const Setting& setting = fastest(table.settings, target, given, structures, path);
  std::string changes;
  for (const auto& [option, value] : options_of(setting, structures)) {
    if (chosen.options.try_emplace(option, value).second) changes += " -" + option + " " + value;
  }
  std::ostringstream text;
  text << "fidelity target " << 100 * target << " %: setting '" << setting.name
       << "', the fastest of " << path << " within it (" << 100 * setting.rms
       << " % from full order there, " << setting.cost
       << " s per second of motion):" << (changes.empty() ? " nothing to change" : changes);
  chosen.note = text.str();
  return chosen;
}

}  // namespace pounding
