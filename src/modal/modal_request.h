#pragma once

#include <vector>

#include "common/types.h"
#include "mesh/nodal_load.h"
#include "system/linear_system.h"

namespace pounding {

/// Request for a basis: its content.
struct ModalRequest {
  int modes = 0;             ///< number of modes; 0: all below the cut-off
  int candidates = 0;        ///< number of lowest modes to choose them from; 0: no others
  double cutoff = 0;         ///< [Hz]
  bool attachment = true;    ///< a vector per contact point as well
  int patches = 0;           ///< or per patch of them, so many in all; 0: per point
  Vector3 gravity{0, 0, 0};  ///< that the structure is to rest under [m/s2]; 0: no vector for it
  std::vector<TracePoint> contact_points;
  std::vector<TracePoint> yielding_points;  ///< of sections that yield, never in patches
  std::vector<TracePoint> other_points;     ///< where the motion is wanted as well
  std::vector<TracePoint> shown_points;     ///< and for pictures and forces, which choose no modes
  std::vector<NodalLoad> loads;             ///< on the structure
  std::vector<double> loads_at_rest;        ///< f of each before the run
  NodalStart start;                         ///< of nodes that start differently
  Vector3 start_displacement{0, 0, 0};      ///< of the others [m]
  Vector3 start_velocity{0, 0, 0};          ///< of the others [m/s]
};

}  // namespace pounding
