#include "scene/unknown_options.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "common/error.h"
#include "common/types.h"
#include "scene/option_blocks.h"
#include "scene/option_values.h"

namespace pounding {
namespace {

using NameSet = std::set<std::string>;

/// The listed names and those that are wholly defined.
NameSet with_complete(const OptionsDatabase& database, OptionBlock block, NameSet names) {
  const std::vector<std::string> complete = complete_names(database, block);
  names.insert(complete.begin(), complete.end());
  return names;
}

NameSet as_set(const std::vector<std::string>& names) {
  return {names.begin(), names.end()};
}

/// Materials or sections that the regions ask for.
NameSet referenced(const OptionsDatabase& database, const ListedNames& listed,
                   std::string_view pattern) {
  NameSet names;
  for (const std::string& structure : listed.at(OptionBlock::structure)) {
    for (const std::string& group : region_groups(database, structure)) {
      const auto entry = database.find(option_name(pattern, {structure, group}));
      if (entry != database.end()) names.insert(trimmed(entry->second));
    }
  }
  return names;
}

/// Names that may replace the placeholders of a block: one list per concrete option.
std::vector<std::vector<std::string>> owners(const OptionsDatabase& database,
                                             const ListedNames& listed, OptionBlock block) {
  std::vector<std::vector<std::string>> result;
  const auto add = [&result](const NameSet& names) {
    for (const std::string& name : names) result.push_back({name});
  };
  switch (block) {
    case OptionBlock::run:
    case OptionBlock::spectra:
      result.emplace_back();
      break;
    case OptionBlock::region:
      for (const std::string& structure : listed.at(OptionBlock::structure)) {
        for (const std::string& group : region_groups(database, structure)) {
          result.push_back({structure, group});
        }
      }
      break;
    case OptionBlock::material:
      add(with_complete(database, block,
                        referenced(database, listed, "<structure>_<group>_material")));
      break;
    case OptionBlock::section:
      add(with_complete(database, block,
                        referenced(database, listed, "<structure>_<group>_section")));
      break;
    case OptionBlock::motion:
      add({"x", "y", "z"});
      break;
    case OptionBlock::support_motion:
    case OptionBlock::support_rotation:
      for (const std::string& support :
           with_complete(database, OptionBlock::support, as_set(listed.at(OptionBlock::support)))) {
        for (const char* axis : direction_names) result.push_back({support, axis});
      }
      break;
    case OptionBlock::structure:
      add(as_set(listed.at(block)));
      break;
    default:
      add(with_complete(database, block, as_set(listed.at(block))));
  }
  return result;
}

/// Whether a region asks for a section or material that nobody defines: its own options of the same
/// kind are those of a name that was meant, and the reference is wrong.
bool has_lost_reference(const OptionsDatabase& database, const ListedNames& listed,
                        const std::string& option) {
  const auto lost = [&](std::string_view reference, std::string_view first) {
    const std::string head(first.substr(0, first.find('<')));
    const NameSet names = referenced(database, listed, reference);
    return std::ranges::any_of(names, [&](const std::string& name) {
      const bool own = option.starts_with(head + name + "_");  // a slip in its own options
      return !own && !database.contains(option_name(first, {name}));
    });
  };
  if (option.starts_with("section_")) {
    return lost("<structure>_<group>_section", "section_<section>_area");
  }
  return option.starts_with("material_") &&
         lost("<structure>_<group>_material", "material_<material>_young");
}

enum class Value { flag, count, integer, above_zero, solver };

struct PetscOption {
  std::string_view pattern;  ///< '*' ends a prefix
  Value value;
};

constexpr auto known_options = std::to_array<PetscOption>({
    {"log_view", Value::flag},
    {"lowest_eps_converged_reason", Value::flag},
    {"lowest_eps_max_it", Value::count},
    {"lowest_eps_monitor", Value::flag},
    {"lowest_eps_mpd", Value::count},
    {"lowest_eps_ncv", Value::count},
    {"lowest_eps_tol", Value::above_zero},
    {"lowest_eps_type", Value::solver},
    {"lowest_eps_view", Value::flag},
    {"lowest_st_mat_mumps_icntl_*", Value::integer},
    {"malloc_debug", Value::flag},
    {"malloc_dump", Value::flag},
    {"malloc_view", Value::flag},
    {"memory_view", Value::flag},
    {"no_signal_handler", Value::flag},
    {"options_left", Value::flag},
    {"rest_ksp_converged_reason", Value::flag},
    {"rest_ksp_max_it", Value::count},
    {"rest_ksp_monitor", Value::flag},
    {"rest_ksp_rtol", Value::above_zero},
    {"rest_ksp_view", Value::flag},
    {"rest_mat_mumps_icntl_*", Value::integer},
});

constexpr auto patterns = [] {
  std::array<std::string_view, known_options.size()> names;
  std::ranges::transform(known_options, names.begin(), &PetscOption::pattern);
  return names;
}();

const std::vector<std::string> eigen_solvers{"krylovschur", "arnoldi"};

bool matches(std::string_view pattern, std::string_view name) {
  return pattern.ends_with('*') ? name.starts_with(pattern.substr(0, pattern.size() - 1))
                                : name == pattern;
}

}  // namespace

void refuse_unknown_options(const OptionsDatabase& database, const ListedNames& in_use) {
  // Scenes that include others take some of their structures.
  ListedNames listed = in_use;
  const NameSet structures =
      with_complete(database, OptionBlock::structure, as_set(in_use.at(OptionBlock::structure)));
  listed[OptionBlock::structure].assign(structures.begin(), structures.end());
  std::vector<std::string> known;
  for (const OptionRow& row : option_table()) {
    for (const std::vector<std::string>& names : owners(database, listed, row.block)) {
      known.push_back(option_name(row.pattern, names));
    }
  }
  const NameSet lookup(known.begin(), known.end());
  for (const auto& [option, value] : database) {
    if (const auto fault = petsc_value_fault(option, value)) {
      throw UserError("option -" + option + " " + shown_value(value) + ": " + *fault);
    }
    if (lookup.contains(option) || is_petsc_option(option)) continue;
    if (has_lost_reference(database, in_use, option)) continue;  // its reader says so
    const auto near = nearest_name(option, known);
    throw UserError("unknown option -" + shown_value(option) + " (value " + shown_value(value) +
                    ")" + (near ? "; did you mean -" + *near + "?" : "; see pounding -help"));
  }
}

std::span<const std::string_view> petsc_option_patterns() {
  return patterns;
}

bool is_petsc_option(std::string_view name) {
  return std::ranges::any_of(patterns,
                             [name](std::string_view pattern) { return matches(pattern, name); });
}

std::optional<std::string> petsc_value_fault(const std::string& name, const std::string& value) {
  const auto option = std::ranges::find_if(
      known_options, [&](const PetscOption& known) { return matches(known.pattern, name); });
  if (option == known_options.end()) return std::nullopt;
  switch (option->value) {
    case Value::flag:
      return parse_boolean(value)
                 ? std::nullopt
                 : std::optional(
                       "expected true, false or no value; it prints to the terminal, no "
                       "file can be named");
    case Value::count:
      return parse_integer(value).value_or(0) > 0 ? std::nullopt
                                                  : std::optional("expected an integer >= 1");
    case Value::integer:
      return parse_integer(value) ? std::nullopt : std::optional("expected an integer");
    case Value::above_zero:
      return parse_real(value).value_or(0) > 0 ? std::nullopt
                                               : std::optional("expected a number > 0");
    case Value::solver:
      break;
  }
  if (std::ranges::find(eigen_solvers, value) != eigen_solvers.end()) return std::nullopt;
  std::string expected = "expected one of:";
  for (const std::string& solver : eigen_solvers) expected += " " + solver;
  return expected + suggestion(value, eigen_solvers);
}

}  // namespace pounding
