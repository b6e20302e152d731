#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/types.h"

/// Values of options from their text. No locale, no exceptions: nothing comes back where the text
/// is not wholly of the kind asked for.
namespace pounding {

std::string trimmed(std::string_view text);

/// The trimmed pieces between separators; "" is one empty piece.
std::vector<std::string> split(std::string_view text, char separator);

/// Whether a number begins with a zero and another digit, as the decimals behind a comma may.
bool has_needless_zero(std::string_view text);

/// The remedy for a value, of one number or a list, in which a comma may be that of decimals; "".
std::string decimal_comma_hint(std::string_view text, bool one);

/// A finite number without a needless zero ("nan", "inf", "1e999" and trailing text are none).
std::optional<double> parse_real(std::string_view text);

/// An integer without fraction or exponent, in the range of int.
std::optional<int> parse_integer(std::string_view text);

/// true yes on 1, false no off 0, in any case; "" (a bare flag) is true.
std::optional<bool> parse_boolean(std::string_view text);

/// "1, 0,0": finite numbers between commas, at least one.
std::optional<std::vector<double>> parse_reals(std::string_view text);

/// "x,y,z": three such numbers.
std::optional<Vector3> parse_point(std::string_view text);

/// "start:stop:COUNTlog", "start:stop:COUNTlin" (ends included exactly) or "f1,f2,...": strictly
/// increasing finite numbers; a logarithmic range needs start > 0.
std::optional<std::vector<double>> parse_increasing(std::string_view text);

/// Whether increasing frequencies [Hz] are such that powers of them are numbers: 1e-6 to 1e6.
bool are_of_oscillators(const std::vector<double>& frequencies);

/// Small letters of the alphabet made capital.
std::string upper_case(std::string_view text);

/// A value fit for a message: one line, not too long, "(no value)" when empty.
std::string shown_value(std::string_view text);

/// Insertions, deletions, replacements and swaps of neighbours that turn one word into the other
/// (optimal string alignment; upper and lower case differ).
int edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `name` if it is near enough to be a slip of the pen (about one letter
/// in five, at least one); the first of equals.
std::optional<std::string> nearest_name(std::string_view name,
                                        const std::vector<std::string>& candidates);

/// "; did you mean concrete?", or "" when nothing is near.
std::string suggestion(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace pounding
