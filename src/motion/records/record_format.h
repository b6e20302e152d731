#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "motion/records/record_text.h"
#include "scene/option_values.h"
#include "scene/scene.h"

namespace pounding {

/// A record of a format that describes itself: values in the file's unit, and their description.
struct FormatRecord {
  std::vector<double> values;
  double time_step = 0;   ///< [s]
  std::string unit;       ///< name, see record_unit
  std::string component;  ///< as the file names it, with its azimuth where it has one
  std::string layout;     ///< format, and changes of the numbers
  std::vector<std::string> doubts{};
};

/// A published format of records, known by marks that nothing else has. `read` is called for files
/// that `recognises` and throws UserError when they break the promise of the marks.
struct RecordFormat {
  std::string_view name;
  bool (*recognises)(std::span<const TextLine> lines);
  FormatRecord (*read)(const RecordedMotion& motion, std::span<const TextLine> lines);
};

bool is_knet(std::span<const TextLine> lines);
FormatRecord read_knet(const RecordedMotion& motion, std::span<const TextLine> lines);
bool is_keyed(std::span<const TextLine> lines);
FormatRecord read_keyed(const RecordedMotion& motion, std::span<const TextLine> lines);
bool is_geonet(std::span<const TextLine> lines);
FormatRecord read_geonet(const RecordedMotion& motion, std::span<const TextLine> lines);
bool is_csmip(std::span<const TextLine> lines);
FormatRecord read_csmip(const RecordedMotion& motion, std::span<const TextLine> lines);
bool is_cosmos(std::span<const TextLine> lines);
FormatRecord read_cosmos(const RecordedMotion& motion, std::span<const TextLine> lines);
bool is_bhrc(std::span<const TextLine> lines);
FormatRecord read_bhrc(const RecordedMotion& motion, std::span<const TextLine> lines);
bool is_smc(std::span<const TextLine> lines);
FormatRecord read_smc(const RecordedMotion& motion, std::span<const TextLine> lines);

/// All formats that have a reader of their own, in the order in which they are tried.
std::span<const RecordFormat> record_formats();

/// The format of a file, null where none recognises it.
const RecordFormat* format_of(std::span<const TextLine> lines);

/// Parts that readers of formats share.

/// Lines from the top within which a format shows its marks.
inline constexpr std::size_t head_lines = 120;

/// The text in small letters.
std::string lower(std::string_view text);

/// The first number in a text; nothing where there is none.
std::optional<double> number_in(std::string_view text);

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
