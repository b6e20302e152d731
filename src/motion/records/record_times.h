#pragma once

#include <string>
#include <vector>

namespace pounding {

/// A time of a record [s] and its line.
struct TimeOfLine {
  double time = 0;
  int line = 0;
};

/// Time step of uniform times. Each may be off its place by a tenth of a step, and where times are
/// written with few decimals by their rounding as well; a whole number of samples a second that
/// explains the rounded times is the rate then. Throws UserError when times do not increase or a
/// step is broken.
double uniform_step(const std::string& file, const std::vector<TimeOfLine>& times);

}  // namespace pounding
