#pragma once

#include <string>
#include <vector>

#include "motion/records/record_text.h"

namespace pounding {

/// Refuses rows of values that run on when the first ones are written otherwise than the rest:
/// with another number of decimals, as the numbers of a header are. Zeros may be written as one
/// likes. Throws UserError.
void refuse_numbers_of_header(const std::string& file, const std::vector<NumberRow>& rows);

/// Refuses values that only an offset explains: all of one sign, from the first to the last away
/// from zero, further than they swing about their mean; counts of a recorder without its zero, or
/// another column. A constant may be meant. Throws UserError.
void refuse_offset(const std::string& file, const std::vector<double>& values);

}  // namespace pounding
