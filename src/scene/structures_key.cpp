#include "scene/structures_key.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "common/hash.h"
#include "scene/option_table.h"
#include "scene/option_values.h"

namespace pounding {
namespace {

using Options = std::vector<std::pair<std::string, std::string>>;

constexpr std::array<std::string_view, 6> representation{
    "model", "modal_", "mass_scaling", "initial_", "time_step_target", "target_"};

std::vector<std::string> names_in(const Options& in_force, std::string_view list) {
  const auto found =
      std::ranges::find(in_force, std::string(list), &std::pair<std::string, std::string>::first);
  return found == in_force.end() ? std::vector<std::string>{} : split(found->second, ',');
}

/// Whether it is an option of a structure, not one of its groups, that only changes how it is
/// represented or how it starts.
bool is_representation(const std::string& option) {
  const std::string pattern = "<structure>_" + option;
  return std::ranges::any_of(representation,
                             [&](std::string_view what) { return option.starts_with(what); }) &&
         std::ranges::any_of(option_table(),
                             [&](const OptionRow& row) { return row.pattern == pattern; });
}

/// Whether it is an option of something of a block, whose name may begin with that of a structure.
bool is_of_block(const std::string& name, OptionBlock block,
                 const std::vector<std::string>& owners) {
  return std::ranges::any_of(option_table(), [&](const OptionRow& row) {
    return row.block == block && std::ranges::any_of(owners, [&](const std::string& owner) {
             return name == option_name(row.pattern, {owner});
           });
  });
}

/// Whether an option describes the structures.
bool belongs(const std::string& name, const std::vector<std::string>& structures,
             const std::vector<std::string>& contacts) {
  if (name.starts_with("material_") || name.starts_with("section_")) return true;
  const auto rest = [&](const std::vector<std::string>& owners) {
    for (const std::string& owner : owners) {
      if (name.starts_with(owner + "_")) return name.substr(owner.size() + 1);
    }
    return std::string();
  };
  const std::string of_contact = rest(contacts);
  if (!of_contact.empty()) return of_contact != "gap" && !of_contact.starts_with("gap_");
  const std::string of_structure = rest(structures);
  return !of_structure.empty() && !is_representation(of_structure);
}

/// Whether an option is a row of the table for one of these structures or contacts.
bool is_of(const std::string& name, const OptionRow& row,
           const std::vector<std::string>& structures, const std::vector<std::string>& contacts) {
  const auto named = [&](const std::string& owner) {
    return name == option_name(row.pattern, {owner});
  };
  if (row.block == OptionBlock::structure) return std::ranges::any_of(structures, named);
  if (row.block == OptionBlock::contact) return std::ranges::any_of(contacts, named);
  if (row.block != OptionBlock::region) return false;
  constexpr std::string_view group = "<group>";
  const std::string_view end = row.pattern.substr(row.pattern.find(group) + group.size());
  return name.ends_with(end) && std::ranges::any_of(structures, [&](const std::string& structure) {
           return name.starts_with(structure + "_");
         });
}

/// Whether it states a preset: options that are new to the program leave the key of a scene that
/// does not use them.
bool is_preset_option(const std::string& name, const std::string& value,
                      const std::vector<std::string>& structures,
                      const std::vector<std::string>& contacts) {
  return std::ranges::any_of(option_table(), [&](const OptionRow& row) {
    return row.preset.has_value && row.preset.text == value &&
           is_of(name, row, structures, contacts);
  });
}

bool is_mesh(const std::string& name, const std::vector<std::string>& structures) {
  return std::ranges::any_of(
      structures, [&](const std::string& structure) { return name == structure + "_mesh"; });
}

/// Numbers by their value, everything else by its text.
void add_value(const std::string& value, Hash& hash) {
  if (const auto numbers = parse_reals(value)) {
    hash.add_all(*numbers);
  } else {
    hash.add(trimmed(value));
  }
}

void add_file(const std::string& path, Hash& hash) {
  std::error_code failure;
  const auto size = std::filesystem::file_size(path, failure);
  std::string beginning(std::size_t{1} << 20, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(file.gcount());
  if (failure || beginning.empty()) {
    hash.add(path);
    return;
  }
  hash.add(static_cast<double>(size));
  hash.add(beginning);
}

}  // namespace

std::string structures_key(const Options& in_force) {
  const std::vector<std::string> structures = names_in(in_force, "structures");
  const std::vector<std::string> contacts = names_in(in_force, "contacts");
  const std::vector<std::string> probes = names_in(in_force, "probes");
  const std::vector<std::string> forces = names_in(in_force, "forces");
  const std::vector<std::string> equipment = names_in(in_force, "equipment");
  Options sorted = in_force;
  std::ranges::sort(sorted);
  Hash hash;
  for (const auto& [name, value] : sorted) {
    if (!belongs(name, structures, contacts) || is_of_block(name, OptionBlock::probe, probes) ||
        is_of_block(name, OptionBlock::force, forces) ||
        is_of_block(name, OptionBlock::equipment, equipment) ||
        is_preset_option(name, value, structures, contacts)) {
      continue;
    }
    hash.add(name);
    if (is_mesh(name, structures)) {
      add_file(value, hash);
    } else {
      add_value(value, hash);
    }
  }
  return hash.text();
}

}  // namespace pounding
