#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/types.h"

namespace pounding {

/// History of a load: a function of time without unit, which multiplies its forces.
struct LoadFunction {
  enum class Kind : std::uint8_t {
    constant,  ///< 1 at all times, before the run as well
    step,      ///< 0 before `start`, then 1
    ramp,      ///< from 0 at `start` to 1 after `rise`, then 1
    harmonic,  ///< sin(2 pi frequency (t - start) + phase) from `start` on, before it 0
    table      ///< linear between the values, the first before them and the last after them
  };
  Kind kind = Kind::constant;
  double start = 0;            ///< [s]
  double rise = 0;             ///< [s]
  double frequency = 0;        ///< [Hz]
  double phase = 0;            ///< [rad]
  std::string file;            ///< of a table; empty: it is given here
  std::vector<double> times;   ///< of a table, increasing [s]
  std::vector<double> values;  ///< of a table [-]
};

/// Forces on a physical group of a structure, all with one history. [SI, along global axes]
struct Load {
  std::string name;
  std::string structure;
  std::string group;
  Vector3 force{0, 0, 0};          ///< on every node of the group [N]
  Vector3 moment{0, 0, 0};         ///< on every node of the group [N m]
  Vector3 line_force{0, 0, 0};     ///< per length of its lines [N/m]
  Vector3 surface_force{0, 0, 0};  ///< per area of its surfaces [N/m2]
  double pressure = 0;             ///< onto its surfaces, against their outer normal [N/m2]
  Vector3 body_force{0, 0, 0};     ///< per volume of its elements [N/m3]
  double factor = 1;               ///< on all of these [-]
  LoadFunction function;
};

}  // namespace pounding
