#pragma once

#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>

#include "elements/element_traits.h"

/// Rows of the table of options, and the words in which the structs of a scene describe them: each
/// has a `describe(option)` that calls its visitor once for every option, in the order of the help,
/// with the member that keeps its value, or without one where a reader makes something else of it.
/// Visitors: the table (scene/option_table.h) and the reader (scene/option_reader.h).
namespace pounding {

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
  pool,
  probe,
  span,
  force,
  equipment,
  spectra
};

enum class OptionKind { text, names, choice, boolean, integer, real, reals };

/// Interval of the admitted values; infinite bounds mean "any finite value".
struct AdmittedRange {
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

  constexpr Preset(bool has, bool owed, std::string_view shown)
      : has_value(has), required(owed), text(shown) {}
  /// The value that holds.
  constexpr Preset(const char* value) : Preset(true, false, value) {}
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

/// Value that an option takes.
struct OptionShape {
  OptionKind kind;
  std::string_view unit;
  Preset preset;
  AdmittedRange range{};  ///< of the number, or of each number of a list
  std::string_view
      form{};  ///< choice: the words, separated by '|'; reals, text: the shape expected
};

/// Marks of an option beside its value.
struct OptionMarks {
  Families families{};  ///< region: elements whose option it is, refused of others; none: all
  Comparisons free{};   ///< run, spectra: in which it may have another value

  constexpr OptionMarks() = default;
  constexpr OptionMarks(Families owners) : families(owners) {}
  constexpr OptionMarks(Comparisons comparisons) : free(comparisons) {}
};

/// Condition of an option: of the members read before it. Where it does not hold
/// the option is refused, with `why`, with the names in place of placeholders, or not read, where
/// there is none.
template <typename Object>
struct OptionNeeds {
  bool (Object::*holds)() const;
  std::string_view why;
};

struct OptionRow : OptionShape, OptionMarks {
  OptionBlock block;
  std::string pattern;  ///< with placeholders: <structure>_<group>_element
  std::string_view help;

  bool is_for(ElementFamily family) const { return families.empty() || families.contains(family); }
};

}  // namespace pounding

/// Words in which options are described.
namespace pounding::option_words {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr AdmittedRange closed(double low, double high) {
  return {low, high, false, false};
}
constexpr AdmittedRange half_open(double low, double high) {
  return {low, high, false, true};
}
constexpr AdmittedRange open(double low, double high) {
  return {low, high, true, true};
}
inline constexpr AdmittedRange any{};
inline constexpr AdmittedRange positive{0, infinity, true, false};
inline constexpr AdmittedRange not_negative{0, infinity, false, false};
inline constexpr AdmittedRange at_least_1{1, infinity, false, false};
inline constexpr AdmittedRange fraction{0, 1, true, false};
inline constexpr AdmittedRange below_1 = half_open(0, 1);
inline constexpr AdmittedRange up_to_1 = closed(0, 1);
inline constexpr AdmittedRange up_to_10 = closed(0, 10);
inline constexpr AdmittedRange damping_ratio = below_1;
inline constexpr AdmittedRange percentage = closed(0, 100);
inline constexpr AdmittedRange digit_count = closed(6, 17);

inline constexpr Preset required{false, true, "required"};
/// No value; `when` says when it is owed, or the meaning of its absence.
constexpr Preset absent(std::string_view when) {
  return {false, false, when};
}

constexpr OptionShape text(std::string_view unit, Preset preset, std::string_view form,
                           AdmittedRange range = any) {
  return {OptionKind::text, unit, preset, range, form};
}
constexpr OptionShape names(Preset preset, std::string_view unit = "names",
                            std::string_view form = "") {
  return {OptionKind::names, unit, preset, any, form};
}
/// One of the words between '|'.
constexpr OptionShape word(std::string_view words, Preset preset) {
  return {OptionKind::choice, "word", preset, any, words};
}
constexpr OptionShape flag(bool preset) {
  return {OptionKind::boolean, "flag", preset ? "true" : "false"};
}
constexpr OptionShape integer(std::string_view unit, Preset preset, AdmittedRange range = any) {
  return {OptionKind::integer, unit, preset, range};
}
constexpr OptionShape real(std::string_view unit, Preset preset, AdmittedRange range = any) {
  return {OptionKind::real, unit, preset, range};
}
constexpr OptionShape reals(std::string_view unit, Preset preset, std::string_view form,
                            AdmittedRange range = any) {
  return {OptionKind::reals, unit, preset, range, form};
}

using Family = ElementFamily;
inline constexpr Families for_shells{Family::shell};
inline constexpr Families for_beams{Family::beam};
inline constexpr Families for_bars{Family::bar};
inline constexpr Families for_points{Family::point_mass};
inline constexpr Families for_single_nodes{Family::point_mass, Family::grounded_spring};
inline constexpr Families for_grounded{Family::grounded_spring};
inline constexpr Families for_bars_and_grounded{Family::bar, Family::grounded_spring};
inline constexpr Families for_springs{Family::grounded_spring, Family::spring};
inline constexpr Families for_beams_and_bars{Family::beam, Family::bar};
inline constexpr Families for_beams_and_shells{Family::beam, Family::shell};
inline constexpr Families for_bars_and_springs{Family::bar, Family::grounded_spring,
                                               Family::spring};
inline constexpr Families for_stiff{Family::solid, Family::shell,           Family::beam,
                                    Family::bar,   Family::grounded_spring, Family::spring};
inline constexpr Families for_extents{Family::solid, Family::shell, Family::beam, Family::bar};
inline constexpr Families for_yielding{Family::shell, Family::beam, Family::bar,
                                       Family::grounded_spring, Family::spring};

template <typename Object>
constexpr OptionNeeds<Object> needs(bool (Object::*holds)() const, std::string_view why = "") {
  return {holds, why};
}

using enum Comparison;
inline constexpr Comparisons free_everywhere{pieces, scene, ensemble, restart};
inline constexpr Comparisons free_but_in_pieces{scene, ensemble, restart};
inline constexpr Comparisons free_but_in_scene{pieces, ensemble, restart};
inline constexpr Comparisons free_but_on_restart{pieces, scene, ensemble};
inline constexpr Comparisons free_of_steps{pieces, restart};
inline constexpr Comparisons free_of_fidelity{pieces, ensemble};
inline constexpr Comparisons free_in_pieces{pieces};
inline constexpr Comparisons free_in_ensemble{ensemble};
inline constexpr Comparisons free_on_restart{restart};

}  // namespace pounding::option_words
