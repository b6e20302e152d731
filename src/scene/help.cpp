#include <algorithm>
#include <string>

#include "scene/option_table.h"

namespace pounding {
namespace {

const char* title_of(OptionBlock block) {
  switch (block) {
    case OptionBlock::run:
      return "The run";
    case OptionBlock::structure:
      return "Each structure";
    case OptionBlock::region:
      return "Each physical group of a structure's mesh that has elements";
    case OptionBlock::material:
      return "Materials";
    case OptionBlock::section:
      return "Cross-sections of beams";
    case OptionBlock::contact:
      return "Contacts";
    case OptionBlock::motion:
      return "Ground motion";
    case OptionBlock::support:
      return "Supports, parts of the ground that move on their own";
    case OptionBlock::support_motion:
      return "Motion of a support along an axis";
    case OptionBlock::support_rotation:
      return "Rotation of a support about an axis";
    case OptionBlock::load:
      return "Loads, forces with a history of their own";
    case OptionBlock::probe:
      return "Probes";
    case OptionBlock::force:
      return "Forces";
    case OptionBlock::equipment:
      return "Equipment on floors";
    case OptionBlock::spectra:
      return "Floor response spectra";
  }
  return "";
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
      "  pounding -help [WORD] | -version\n"
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
    if (first || row.block != block) text.append("\n").append(title_of(row.block)).append("\n");
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

}  // namespace pounding
