#pragma once

#include <optional>
#include <string>
#include <vector>

#include "motion/records/record_header.h"
#include "motion/records/record_text.h"
#include "scene/scene.h"

namespace pounding {

/// The values of a record, in the file's unit, and how they were found in it.
struct RecordValues {
  std::vector<double> values;
  double time_step = 0;               ///< of the time column [s]; 0: there is none
  std::optional<double> start{};      ///< first time of that column [s]
  std::string component{};            ///< name of the column, "" where it has none
  std::string layout{};               ///< "column 2 of 2, time in column 1"
  std::vector<std::string> doubts{};  ///< one line each: where the layout may be another one
};

/// Values of a text file: those of the column that `motion` asks for; without one, those of the
/// column beside the time, pairs of time and value that run on from row to row, or values that do.
/// The time is the column whose name begins with a t, or where there are no names the first one;
/// never one that counts 0, 1, 2, ... or 1, 2, 3, ... Throws UserError when there are more columns
/// and none is asked for, when rows have different lengths, when the first ones seem to be numbers
/// of a header, and when times are not uniform.
RecordValues read_record_values(const RecordedMotion& motion, const RecordContent& content);

/// Refuses rows of values that run on when the first ones are written otherwise than the rest:
/// with another number of decimals, as the numbers of a header are. Zeros may be written as one
/// likes. Throws UserError.
void refuse_numbers_of_header(const std::string& file, const std::vector<NumberRow>& rows);

/// Refuses values that only an offset explains: all of one sign, from the first to the last away
/// from zero, further than they swing about their mean; counts of a recorder without its zero, or
/// another column. A constant may be meant. Throws UserError.
void refuse_offset(const std::string& file, const std::vector<double>& values);

}  // namespace pounding
