#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/profile.h"
#include "driver/building.h"
#include "driver/separation_rules.h"
#include "driver/step_limits.h"
#include "interactions/pairing/interface.h"
#include "mesh/force_places.h"
#include "mesh/mesh.h"
#include "mesh/nodal_load.h"
#include "mesh/probe_set.h"
#include "motion/ground_motion.h"
#include "motion/load_histories.h"
#include "motion/support_motion.h"
#include "scene/scene.h"
#include "statics/equilibrium.h"
#include "system/linear_system.h"
#include "system/load_shapes.h"

namespace pounding {

/// Gaps of the pairs of a contact before the run, the smallest and the largest [m].
struct JointGaps {
  std::array<double, 2> unloaded{};  ///< of undeformed structures
  std::array<double, 2> at_rest{};   ///< at the rest that the run starts from; the same without one
};

/// Everything about a scene that is constant in time, on this rank.
struct Model {
  std::vector<Mesh> meshes;  ///< per structure, one after the other for the solver
  /// Numbers of the nodes in the mesh file, per structure, by file order; on rank 0, where matrices
  /// are exported and the mesh was read whole.
  std::vector<std::vector<std::int64_t>> node_tags;
  std::vector<LinearSystem> systems;  ///< per structure
  std::vector<Building> buildings;    ///< per structure: these two and findings about them
  interactions::Interface interface;  ///< reports on rank 0 only
  std::vector<ResolvedProbe> probes;
  std::vector<ResolvedForce> forces;
  std::vector<NodalLoad> loads;    ///< of the scene, on every rank
  std::vector<NodalStart> starts;  ///< per structure, on every rank
  std::unique_ptr<GroundMotion> motion;
  std::unique_ptr<SupportMotion> supports;        ///< null where the ground moves as one
  std::unique_ptr<LoadHistories> load_histories;  ///< null where no load acts
  std::optional<Equilibrium> equilibrium;         ///< that the run starts from
  /// Gaps of the rows of the interface at the start, at rest where the run starts so [m].
  std::vector<double> start_gaps;
  std::vector<JointGaps> joint_gaps;  ///< per contact
  double partition_imbalance = 1;
  long partition_edge_cut = 0;
  double filler_time_step = std::numeric_limits<double>::infinity();  ///< see filler_limit [s]
  double time_step = 0;                                               ///< in force [s]
  std::int64_t steps = 0;                                             ///< until the end time
  std::vector<Separation> separations;      ///< that the joints would need; on rank 0
  std::vector<std::string> warnings;        ///< doubts, one line each, on rank 0
  std::vector<ResolvedProbe> storey_bases;  ///< see find_storey_bases
  StepLimits step_limits;
  StepSource step_source = StepSource::given;  ///< of the time step in force
  /// Components of the supports' motion that differ from the ground's.
  std::span<const SupportColumn> support_columns() const {
    return supports ? std::span<const SupportColumn>(supports->columns())
                    : std::span<const SupportColumn>();
  }
  /// Loads as they are on the meshes, and before the run.
  SceneLoads scene_loads() const {
    SceneLoads all{loads, {}};
    for (std::size_t l = 0; load_histories && l < load_histories->size(); ++l) {
      all.before_start.push_back(load_histories->before_start(l));
    }
    return all;
  }
  /// Free ones of all structures over all ranks.
  std::size_t dofs() const {
    std::size_t sum = 0;
    for (const Mesh& mesh : meshes) sum += static_cast<std::size_t>(mesh.global_dofs);
    return sum;
  }
  double smallest_stable_time_step() const {
    const double smallest = std::ranges::min_element(buildings, {}, [](const Building& building) {
                              return building.limits.stable_time_step;
                            })->limits.stable_time_step;
    return std::min(smallest, filler_time_step);
  }
};

}  // namespace pounding
