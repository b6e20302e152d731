#include "scene/option_blocks.h"

#include <algorithm>
#include <array>

namespace pounding {
namespace {

constexpr std::array<std::string_view, 6> reserved_heads{"material", "section", "motion",
                                                         "spectra",  "lowest",  "largest"};
constexpr std::array<std::string_view, 7> reserved_words{
    "none", "wall", "include", "options", "options_file", "help", "version"};

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool is_name_character(char c) {
  return is_letter(c) || (c >= '0' && c <= '9') || c == '_';
}

/// Whether a structure names its elements.
bool has_elements(const OptionsDatabase& database, const std::string& structure) {
  return std::ranges::any_of(region_groups(database, structure), [&](const std::string& group) {
    return database.contains(option_name("<structure>_<group>_element", {structure, group}));
  });
}

bool is_complete(const OptionsDatabase& database, OptionBlock block, const std::string& name) {
  const bool whole = std::ranges::all_of(option_table(), [&](const OptionRow& row) {
    return row.block != block || !row.preset.required ||
           database.contains(option_name(row.pattern, {name}));
  });
  return whole && (block != OptionBlock::structure || has_elements(database, name)) &&
         (block != OptionBlock::probe || database.contains(option_name("<probe>_at", {name})) ||
          database.contains(option_name("<probe>_group", {name})));
}

}  // namespace

std::set<std::string> region_groups(const OptionsDatabase& database, const std::string& structure) {
  std::vector<std::string> patterns;
  for (const OptionRow& row : option_table()) {
    if (row.block != OptionBlock::region) continue;
    patterns.push_back(structure + "_<group>" +
                       std::string(row.pattern.substr(row.pattern.rfind('>') + 1)));
  }
  std::set<std::string> groups;
  for (const auto& [option, value] : database) {
    if (!option.starts_with(structure + "_")) continue;
    // mat_mass_per_area: an option of mat, unless it is the area of an element mat_mass_per.
    std::string shortest;
    bool has_element = false;
    for (const std::string& pattern : patterns) {
      const auto group = match_option(pattern, option);
      if (!group) continue;
      if (shortest.empty() || group->size() < shortest.size()) shortest = *group;
      if (database.contains(option_name("<structure>_<group>_element", {structure, *group}))) {
        groups.insert(*group);
        has_element = true;
      }
    }
    if (!has_element && !shortest.empty()) groups.insert(shortest);
  }
  return groups;
}

std::vector<std::string> complete_names(const OptionsDatabase& database, OptionBlock block) {
  const auto first = std::ranges::find_if(option_table(), [block](const OptionRow& row) {
    return row.block == block && row.preset.required;
  });
  std::vector<std::string> names;
  for (const auto& [option, value] : database) {
    const auto name = match_option(first->pattern, option);
    if (name && is_complete(database, block, *name)) names.push_back(*name);
  }
  return names;
}

std::optional<std::string> name_fault(const std::string& name) {
  if (name.empty() || !is_letter(name[0]) || !std::ranges::all_of(name, is_name_character)) {
    return "'" + name + "' is not a name (a letter, then letters, digits and _)";
  }
  const bool own_word =
      std::ranges::find(reserved_words, name) != reserved_words.end() ||
      std::ranges::any_of(option_table(),
                          [&](const OptionRow& row) { return row.pattern == name; }) ||
      std::ranges::any_of(reserved_heads, [&](std::string_view head) {
        return name == head || name.starts_with(std::string(head) + "_");
      });
  if (own_word || is_petsc_option(name)) {
    return "'" + name + "' is a word of the options or of PETSc's, choose another name";
  }
  return std::nullopt;
}

}  // namespace pounding
