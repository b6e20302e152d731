#pragma once

#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "elements/element_traits.h"

/// The one place where the options of a scene are declared: reader, help, resolved options and the
/// check for unknown names all work from this table.
namespace pounding {

/// Options as PETSc flattens them: name without the leading '-' -> value ("" for a bare flag).
using OptionsDatabase = std::map<std::string, std::string>;

/// Block that an option belongs to; each but `run`, `motion` and `spectra` repeats per user's name,
/// and the options of a support's motion per axis as well.
enum class OptionBlock {
  run,
  structure,
  region,
  material,
  section,
  contact,
  motion,
  support,
  support_motion,
  support_rotation,
  load,
  probe,
  force,
  equipment,
  spectra
};

enum class OptionKind { text, names, choice, boolean, integer, real, reals };

/// Interval of the admitted values; infinite bounds mean "any finite value".
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
  bool high_open = false;

  bool contains(double number) const;
  std::string text() const;  ///< "> 0", "(0, 1]", "any"
};

/// Preset, which holds when the user is silent: a value, or nothing (`text` says when it is owed).
struct Preset {
  bool has_value = false;
  bool required = false;
  std::string_view text;
};

/// Set of values of an enumeration, a bit each.
template <typename Enumeration>
class SetOf {
 public:
  constexpr SetOf() = default;
  constexpr SetOf(std::initializer_list<Enumeration> values) {
    for (const Enumeration value : values) bits_ |= bit(value);
  }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr bool contains(Enumeration value) const { return (bits_ & bit(value)) != 0; }

 private:
  static constexpr unsigned bit(Enumeration value) { return 1U << static_cast<unsigned>(value); }

  unsigned bits_ = 0;
};

using Families = SetOf<ElementFamily>;

/// Comparison of two runs by their options: of the meshes, contacts, probes and shares that pieces
/// of meshes were written for; of the physics with that of the scene file; of the numbers of an
/// ensemble with those already computed; of a run with the one that it continues (the time step
/// itself is compared, not its options).
enum class Comparison { pieces, scene, ensemble, restart };

using Comparisons = SetOf<Comparison>;

struct OptionRow {
  OptionBlock block;
  std::string_view pattern;  ///< with placeholders: <structure>_<group>_element
  OptionKind kind;
  std::string_view unit;
  Preset preset;
  Range range;            ///< of the number, or of each number of a list
  std::string_view form;  ///< choice: the words, separated by '|'; reals, text: the shape expected
  std::string_view help;
  Families families{};  ///< region: elements whose option it is, refused of others; none: all
  Comparisons free{};   ///< run, spectra: in which it may have another value

  bool is_for(ElementFamily family) const { return families.empty() || families.contains(family); }
};

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

}  // namespace pounding

/// Words in which the rows of all option tables are written.
namespace pounding::option_words {

using Block = OptionBlock;
using Kind = OptionKind;

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr Range any{};
inline constexpr Range positive{0, infinity, true, false};
inline constexpr Range not_negative{0, infinity, false, false};
inline constexpr Range at_least_1{1, infinity, false, false};
inline constexpr Range damping_ratio{0, 1, false, true};
inline constexpr Range patch_count{0, 10000, false, false};
inline constexpr Range csv_digits{6, 17, false, false};

constexpr Preset value(std::string_view text) {
  return {true, false, text};
}
/// No value; `when` says when it is owed, or the meaning of its absence.
constexpr Preset absent(std::string_view when) {
  return {false, false, when};
}

}  // namespace pounding::option_words
