#pragma once

#include <string>
#include <vector>

#include "motion/records/record_header.h"
#include "motion/records/record_text.h"

namespace pounding {

/// A record of text, header and numbers apart, before their layout is decided.
struct RecordContent {
  RecordHeader header;
  std::vector<NumberRow> rows;     ///< the values, line by line
  std::vector<std::string> names;  ///< of the columns, when the header gives as many as there are
};

/// Splits the lines of `file`; a first row of its own kind (`npts dt`, `npts`, or `dt scale` with
/// the time step known from the header or the option) goes to the header. Throws UserError when
/// there are no numbers, or anything else among them, and when the header is not an accelerogram's.
RecordContent read_record_content(const std::string& file, const std::vector<TextLine>& lines,
                                  double time_step_option);

}  // namespace pounding
