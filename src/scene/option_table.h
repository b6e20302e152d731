#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/option_row.h"

/// The table of options, made of the descriptions of a scene's structs: help, resolved options and
/// the checks for unknown and idle names all work from it.
namespace pounding {

/// Options as PETSc flattens them: name without the leading '-' -> value ("" for a bare flag).
using OptionsDatabase = std::map<std::string, std::string>;
/// Names and values of options in an order of their own.
using OptionValues = std::vector<std::pair<std::string, std::string>>;

/// A kind of owner of options.
struct OptionOwner {
  OptionBlock block;
  std::string_view name;
  std::string_view title;  ///< above its options in the help
  std::string_view list;   ///< option that lists the user's names of them; empty: there is none
};

/// Every kind, in the order of OptionBlock.
std::span<const OptionOwner> option_owners();

/// Names that the user's lists have, by their kind.
using ListedNames = std::map<OptionBlock, std::vector<std::string>>;

/// Every option, in the order of the help.
std::span<const OptionRow> option_table();

/// Options of pounding-spectra, likewise; their patterns begin with another '-'.
std::span<const OptionRow> spectra_option_table();

/// The row of a pattern of either table. Throws std::logic_error for one that is in none.
const OptionRow& option_row(std::string_view pattern);

/// The pattern with its placeholders replaced, in order, by `names`.
std::string option_name(std::string_view pattern, const std::vector<std::string>& names);

/// The text in place of the only placeholder of `pattern` in `name`, if it matches.
std::optional<std::string> match_option(std::string_view pattern, std::string_view name);

/// Description of an allowed value, with range and unit: "a number in (0, 1] [-]".
std::string expected_text(const OptionRow& row);

/// Options of PETSc and SLEPc allowed beside those of the scene; '*' ends a prefix.
std::span<const std::string_view> petsc_option_patterns();
bool is_petsc_option(std::string_view name);

/// Whether two runs may have different values of the option `name` in a comparison: of those that
/// the table marks as free in it, and of those of PETSc and SLEPc.
bool may_differ(std::string_view name, Comparison comparison);

/// The text of `pounding -help`: usage, every option with unit, default, range and one line, and
/// the admitted PETSc and SLEPc names; `about`: of the options that have it in name or line alone.
std::string help_text(const std::string& about = "");

/// The text of `pounding -help_json`, for editors and other programs: a list with an object for
/// each option, of its name, owner, kind, unit, default (or null, and when it is owed),
/// range, words or form, and help.
std::string help_json();

}  // namespace pounding
