#include "scene/option_table.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "scene/row_collector.h"
#include "scene/scene.h"

namespace pounding {
namespace {

/// Adds the options of each owner of a block.
template <typename Owner>
void add(OptionBlock block, RowCollector& collector) {
  collector.block = block;
  Owner::describe(collector);
}

std::vector<OptionRow> rows_of_scene() {
  RowCollector rows;
  add<Scene>(OptionBlock::run, rows);
  add<StruckPlaces>(OptionBlock::run, rows);
  add<Structure>(OptionBlock::structure, rows);
  add<Region>(OptionBlock::region, rows);
  add<Material>(OptionBlock::material, rows);
  add<Section>(OptionBlock::section, rows);
  add<Contact>(OptionBlock::contact, rows);
  add<MotionComponent>(OptionBlock::motion, rows);
  add<Support>(OptionBlock::support, rows);
  add<SupportMotionOptions>(OptionBlock::support_motion, rows);
  add<SupportRotationOptions>(OptionBlock::support_rotation, rows);
  add<Load>(OptionBlock::load, rows);
  add<Pool>(OptionBlock::pool, rows);
  add<Probe>(OptionBlock::probe, rows);
  add<Span>(OptionBlock::span, rows);
  add<ForceItem>(OptionBlock::force, rows);
  add<Equipment>(OptionBlock::equipment, rows);
  add<SpectraRequest>(OptionBlock::spectra, rows);
  return rows.rows;
}

}  // namespace

bool AdmittedRange::contains(double number) const {
  const bool above = low_open ? number > low : number >= low;
  const bool below = high_open ? number < high : number <= high;
  return above && below;
}

std::string AdmittedRange::text() const {
  std::ostringstream text;
  if (std::isinf(low) && std::isinf(high)) {
    text << "any";
  } else if (std::isinf(high)) {
    text << (low_open ? "> " : ">= ") << low;
  } else {
    text << (low_open ? "(" : "[") << low << ", " << high << (high_open ? ")" : "]");
  }
  return text.str();
}

std::span<const OptionOwner> option_owners() {
  using enum OptionBlock;
  static constexpr OptionOwner owners[] = {
      {run, "run", "The run", ""},
      {structure, "structure", "Each structure", "structures"},
      {region, "region", "Each physical group of a structure's mesh that has elements", ""},
      {material, "material", "Materials", ""},
      {section, "section", "Cross-sections of beams", ""},
      {contact, "contact", "Contacts", "contacts"},
      {motion, "motion", "Ground motion", ""},
      {support, "support", "Supports, parts of the ground that move on their own", "supports"},
      {support_motion, "support_motion", "Motion of a support along an axis", ""},
      {support_rotation, "support_rotation", "Rotation of a support about an axis", ""},
      {load, "load", "Loads, forces with a history of their own", "loads"},
      {pool, "pool", "Pools, water in tanks of structures", "pools"},
      {probe, "probe", "Probes", "probes"},
      {span, "span", "Spans from one structure to another", "spans"},
      {force, "force", "Forces", "forces"},
      {equipment, "equipment", "Equipment on floors", "equipment"},
      {spectra, "spectra", "Floor response spectra", ""}};
  return owners;
}

std::span<const OptionRow> option_table() {
  static const std::vector<OptionRow> rows = rows_of_scene();
  return rows;
}

const OptionRow& option_row(std::string_view pattern) {
  const auto table = pattern.starts_with('-') ? spectra_option_table() : option_table();
  const auto row = std::ranges::find(table, pattern, &OptionRow::pattern);
  if (row == table.end()) {
    throw std::logic_error("no option has the pattern " + std::string(pattern));
  }
  return *row;
}

std::string option_name(std::string_view pattern, const std::vector<std::string>& names) {
  std::string result;
  auto name = names.begin();
  while (true) {
    const std::size_t open = pattern.find('<');
    result += pattern.substr(0, open);
    if (open == std::string_view::npos) break;
    if (name == names.end()) {
      throw std::logic_error("a placeholder without a name in " + std::string(pattern));
    }
    result += *name++;
    pattern.remove_prefix(pattern.find('>') + 1);
  }
  if (name != names.end()) throw std::logic_error("more names than placeholders for " + result);
  return result;
}

std::optional<std::string> match_option(std::string_view pattern, std::string_view name) {
  const std::string_view head = pattern.substr(0, pattern.find('<'));
  const std::string_view tail = pattern.substr(pattern.find('>') + 1);
  if (name.size() <= head.size() + tail.size() || !name.starts_with(head) ||
      !name.ends_with(tail)) {
    return std::nullopt;
  }
  return std::string(name.substr(head.size(), name.size() - head.size() - tail.size()));
}

std::string expected_text(const OptionRow& row) {
  const bool ranged = row.range.text() != "any";
  const std::string unit = " [" + std::string(row.unit) + "]";
  const std::string range = ranged ? " " + row.range.text() : "";
  const std::string within = (ranged && range[1] != '>' ? " in" : "") + range;
  switch (row.kind) {
    case OptionKind::names:
      return row.preset.required ? "a comma-separated list of at least one name"
                                 : "a comma-separated list of names, or none";
    case OptionKind::choice: {
      std::string words(row.form);
      std::ranges::replace(words, '|', ' ');
      return words.find(' ') == std::string::npos ? words + " (the only one supported now)"
                                                  : "one of: " + words;
    }
    case OptionKind::boolean:
      return "true or false";
    case OptionKind::integer:
      return "an integer" + within + unit;
    case OptionKind::real:
      return "a number" + within + unit;
    case OptionKind::text:
    case OptionKind::reals:
      break;
  }
  const bool numeric = row.kind == OptionKind::reals || ranged || row.unit == "m";
  return std::string(row.form) + (ranged ? ", each" + within : "") + (numeric ? unit : "");
}

bool may_differ(std::string_view name, Comparison comparison) {
  if (is_petsc_option(name)) return true;
  const auto row = std::ranges::find(option_table(), name, &OptionRow::pattern);
  return row != option_table().end() && row->free.contains(comparison);
}

}  // namespace pounding
