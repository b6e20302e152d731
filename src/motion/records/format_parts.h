#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "motion/records/record_format.h"

/// Parts that readers of formats share.
namespace pounding {

/// Lines from the top within which a format shows its marks.
inline constexpr std::size_t head_lines = 120;

/// The text in small letters.
std::string lower(std::string_view text);

/// The first number in a text; nothing where there is none.
std::optional<double> number_in(std::string_view text);

/// The text between blanks.
std::string stripped(std::string_view text);

/// Values of a block of rows, and the place of the line behind it.
struct NumberBlock {
  std::vector<double> values;
  std::size_t end = 0;
};

/// Reads `count` values from line `begin` (from 0) on, in rows of one length; zeros may fill up the
/// last. Throws UserError when a line holds anything else, when rows break and when lines run out.
NumberBlock read_block(const std::string& file, std::span<const TextLine> lines, std::size_t begin,
                       std::size_t count);

/// Throws UserError when numbers follow a block whose count the line `announced` states.
void require_end(const std::string& file, std::span<const TextLine> lines, const NumberBlock& block,
                 int announced);

/// A number of values that a header announces. Throws UserError when it cannot be one.
std::size_t count_of(const std::string& file, int line, double announced);

/// Throws UserError when a step is not between 1e-5 and 1 s, or contradicts the one asked for.
double agreed_step(const RecordedMotion& motion, int line, double time_step);

/// The part, from 0, that `motion` asks for by its column, or the only one. Throws UserError, with
/// the names of all, when there are several and none is asked for, or no such one.
std::size_t choose_component(const RecordedMotion& motion, const std::vector<std::string>& names);

/// The peak that a header states, which shows whether the values are the record's and the unit is
/// the right one. Throws UserError when the values' peak is another by more than `part` of it.
void require_peak(const std::string& file, int line, double stated,
                  const std::vector<double>& values, double part = 0.1);

}  // namespace pounding
