#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/profile.h"
#include "contact/interface.h"
#include "mesh/connectivity.h"
#include "mesh/mesh.h"
#include "mesh/probe_set.h"
#include "modal/modal_analysis.h"
#include "modal/modal_basis.h"
#include "motion/ground_motion.h"
#include "scene/scene.h"
#include "system/linear_system.h"

namespace pounding {

/// What the checks of a structure's mesh found.
struct MeshFindings {
  Connectivity connectivity;
  std::vector<UnusedElements> unused;  ///< places that no option of the scene names
};

/// Everything about a scene that is constant in time, on this rank. Vectors run over the scene's
/// structures.
struct Model {
  std::vector<Mesh> meshes;
  std::vector<MeshFindings> mesh_findings;  ///< on rank 0 only
  std::vector<LinearSystem> systems;
  std::vector<std::optional<ModalBasis>> bases;  ///< of the structures that are reduced; no rows
  std::vector<ModalResult> modal;
  std::vector<LargestFrequency> largest;
  std::vector<double> stable_time_step;  ///< exact, per structure [s]
  std::vector<double> energy_margin;     ///< of the time step in force, per structure [-]
  Interface interface;                   ///< reports on rank 0 only
  std::vector<ResolvedProbe> probes;
  std::unique_ptr<GroundMotion> motion;
  double partition_imbalance = 1;
  long partition_edge_cut = 0;
  double time_step = 0;               ///< in force [s]
  std::int64_t steps = 0;             ///< until the end time
  std::vector<std::string> warnings;  ///< one line each, on rank 0: what may not be meant
  double smallest_stable_time_step() const {
    return *std::min_element(stable_time_step.begin(), stable_time_step.end());
  }
};

}  // namespace pounding
