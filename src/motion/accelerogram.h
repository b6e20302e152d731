#pragma once

#include <string>
#include <vector>

#include "motion/records/record_unit.h"
#include "scene/scene.h"

namespace pounding {

/// Ground acceleration at t = start, start + time_step, start + 2 time_step, ...
struct Accelerogram {
  std::vector<double> acceleration{};  ///< [m/s2]
  double time_step = 0;                ///< [s]
  std::string layout{};                ///< of the file that it was read from
  std::string unit{};                  ///< of that file, and its source
  std::vector<std::string> doubts{};   ///< one line each: where the file may mean something else
  std::string component{};             ///< as the file names it; "" where it does not
  double start = 0;                    ///< time of the first value [s]
  bool has_times = false;              ///< the file states the time of its first value

  double peak() const;                               ///< max |acceleration| [m/s2]
  double duration() const;                           ///< between the first value and the last [s]
  double end() const { return start + duration(); }  ///< time of the last value [s]
  /// The acceleration at time t, linear between samples, zero before the first and after the last.
  double at(double t) const noexcept;
};

/// Reads an accelerogram from a text file, whatever the layout it has:
/// - the formats of record_formats(), each by a reader of its own;
/// - PEER AT2: free header with NPTS and DT in any of their styles, values in rows;
/// - rows of fixed-width values, which may touch (SHAKE), or of pairs of time and value;
/// - one column of values (needs `time_step` when no header states it);
/// - columns of which one is the time (uniform), separated by blanks, tabs, commas or semicolons,
///   with or without a line of names; `column` chooses one and is needed where there are more than
///   two; numbers may have decimal commas;
/// - JSON with `dT` and `accel_data`.
///
/// Comments begin with % ; # ! or *; the byte-order mark, carriage returns, trailing blanks and
/// zeros after NPTS values are dropped. The unit comes from `unit` or from the header; g =
/// standard_gravity. A displacement, by its `unit`, becomes an acceleration. `start` is the first
/// time of a time column. Throws UserError (one line: file, line, value seen, remedy) when the file
/// is missing, empty, without an end, ragged, holds anything that is not a finite number, when
/// header, options and values contradict one another, when numbers above the values may be some of
/// them, when only an offset explains them, and when its time step is above 0.1 s but `time_step`
/// does not say so.
Accelerogram read_accelerogram(const RecordedMotion& motion);

}  // namespace pounding
