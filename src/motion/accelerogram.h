#pragma once

#include <string>
#include <vector>

#include "motion/acceleration_limits.h"
#include "scene/scene.h"

namespace pounding {

/// Ground acceleration at t = 0, time_step, 2 time_step, ...
struct Accelerogram {
  std::vector<double> acceleration{};  ///< [m/s2]
  double time_step = 0;                ///< [s]
  std::string layout{};                ///< of the file that it was read from
  std::string unit{};                  ///< of that file, and who said it
  std::vector<std::string> doubts{};   ///< one line each: where the file may mean something else

  double peak() const;      ///< max |acceleration| [m/s2]
  double duration() const;  ///< time of the last value [s]
};

/// Reads an accelerogram from a text file, whatever the layout it has:
/// - PEER AT2: free header with NPTS and DT in any of their styles, values in rows;
/// - CSMIP and SHAKE rows of fixed-width values, which may touch;
/// - one column of values (needs `time_step` when no header tells it);
/// - columns of which one is the time (uniform), separated by blanks, tabs, commas or semicolons,
///   with or without a line of names; `column` chooses one and is needed where there are more than
///   two;
/// - JSON with `dT` and `accel_data`.
/// Comments begin with % ; # ! or *; the byte-order mark, carriage returns, trailing blanks and
/// zeros after NPTS values are dropped.
/// The unit comes from `unit` or from the header; g = standard_gravity. The time of the first value
/// becomes 0. Throws UserError (one line: file, line, what was seen, what to do) when the file is
/// missing, empty, ragged, holds anything that is not a finite number, when header, options and
/// values contradict one another, and when its time step is above 0.1 s but `time_step` does not
/// say so.
Accelerogram read_accelerogram(const RecordedMotion& motion);

}  // namespace pounding
