#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

#include "scene/option_table.h"

namespace pounding {
namespace {

const OptionOwner& owner_of(const OptionRow& row) {
  return option_owners()[static_cast<std::size_t>(row.block)];
}

std::string preset_of(const OptionRow& row) {
  if (row.preset.required) return "required";
  if (!row.preset.has_value) return std::string(row.preset.text);
  return row.preset.text.empty() ? "default: empty" : "default: " + std::string(row.preset.text);
}

/// Whether the form says more than the unit does.
bool has_shape(const OptionRow& row) {
  return row.kind != OptionKind::choice && row.form.find_first_of(",:") != std::string_view::npos;
}

void append(std::string& text, const OptionRow& row) {
  std::string line = "  -";
  line.append(row.pattern);
  line.resize(std::max<std::size_t>(line.size() + 1, 38), ' ');
  line.append("[").append(row.unit).append("] ");
  line.resize(std::max<std::size_t>(line.size(), 46), ' ');
  line.append(row.help).append("; ").append(preset_of(row));
  const std::string range = row.range.text();
  if (row.kind == OptionKind::choice) {
    line.append("; one of ").append(row.form);
  } else if (has_shape(row)) {
    line.append("; ").append(row.form);
  }
  if (row.kind != OptionKind::choice && range != "any") {
    line.append(range[0] == '>' ? "; " : "; in ").append(range);
  }
  text.append(line).append("\n");
}

}  // namespace

std::string help_text(const std::string& about) {
  std::string text =
      "pounding: response of floors when two buildings hit each other in an earthquake\n"
      "\n"
      "  mpirun -n 2 pounding -options_file case.yaml [-name value ...]\n"
      "  pounding -help [WORD] | -help_json | -version\n"
      "\n"
      "Options come from YAML files (nested keys join with _: s1: {slab: {element: hex8}} is\n"
      "-s1_slab_element hex8), from the files that they name as include, and from the command\n"
      "line, which wins. -dry_run checks a case. Names in <> are the user's; units are SI.\n";
  bool first = true;
  OptionBlock block{};
  if (!about.empty()) text.clear();
  for (const OptionRow& row : option_table()) {
    const std::string line = std::string(row.pattern).append(" ").append(row.help);
    if (line.find(about) == std::string::npos) continue;
    if (first || row.block != block) text.append("\n").append(owner_of(row).title).append("\n");
    first = false;
    block = row.block;
    append(text, row);
  }
  if (!about.empty()) return text.empty() ? "no option has '" + about + "' in its line\n" : text;
  text += "\nOptions of PETSc and SLEPc that pass through:\n ";
  std::size_t width = 1;
  for (const std::string_view pattern : petsc_option_patterns()) {
    if (width + pattern.size() + 2 > 96) {
      text += "\n ";
      width = 1;
    }
    text.append(" -").append(pattern);
    width += pattern.size() + 2;
  }
  return text + "\n";
}

std::string help_json() {
  using Value = nlohmann::ordered_json;
  constexpr std::array kinds{"text", "names", "choice", "boolean", "integer", "real", "reals"};
  const auto bound = [](double number) { return std::isfinite(number) ? Value(number) : Value(); };
  Value options = Value::array();
  for (const OptionRow& row : option_table()) {
    const Preset& preset = row.preset;
    options.push_back({{"name", row.pattern},
                       {"block", owner_of(row).name},
                       {"kind", kinds[static_cast<std::size_t>(row.kind)]},
                       {"unit", row.unit},
                       {"required", preset.required},
                       {"default", preset.has_value ? Value(preset.text) : Value()},
                       {"absent", preset.has_value ? "" : preset.text},
                       {"range", row.range.text()},
                       {"low", bound(row.range.low)},
                       {"high", bound(row.range.high)},
                       {"form", row.form},
                       {"help", row.help}});
  }
  return options.dump(1) + "\n";
}

}  // namespace pounding
