#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "interactions/pairing/absorbing_faces.h"
#include "interactions/pairing/interface.h"
#include "mesh/connectivity.h"
#include "mesh/divide_beams.h"
#include "mesh/force_places.h"
#include "mesh/global_mesh.h"
#include "mesh/gmsh_reader.h"
#include "mesh/mesh.h"
#include "mesh/mesh_waves.h"
#include "mesh/nodal_load.h"
#include "mesh/probe_set.h"
#include "modal/modal_analysis.h"
#include "modal/modal_basis.h"
#include "model/beam_waves.h"
#include "motion/ground_motion.h"
#include "motion/load_histories.h"
#include "motion/support_motion.h"
#include "scene/scene.h"
#include "stability/resolved_motion.h"
#include "stability/stable_time_step.h"
#include "stability/step_target.h"
#include "statics/equilibrium.h"
#include "system/element_forces.h"
#include "system/linear_system.h"
#include "system/load_shapes.h"

namespace pounding {

/// Findings of the checks of a structure's mesh.
struct MeshFindings {
  Connectivity connectivity;
  std::vector<UnusedElements> unused;  ///< places that no option of the scene names
  MeshFiles files;
  std::vector<DividedLines> divided;  ///< regions whose lines were cut into beams
  MeshWaves waves;

  static void members(auto& self, auto& stream) {
    stream(self.files.opened, self.connectivity, self.unused, self.divided, self.waves);
  }
};

/// One structure of the scene as it was built: its mesh and its system, and all that was found out
/// about them. Constant during a run.
struct Building {
  const Structure* structure = nullptr;     ///< as the user asked for it; of the scene
  const Mesh* mesh = nullptr;               ///< this rank's part; borrowed from the model
  const LinearSystem* system = nullptr;     ///< borrowed from the model
  MeshFindings findings;                    ///< on rank 0 only
  interactions::AbsorbingReport absorbing;  ///< on rank 0 only
  std::vector<SpreadReport> spread;         ///< on rank 0 only
  std::optional<ModalBasis> basis;          ///< if the structure is reduced; no rows
  /// If it is stepped in modes while nothing strikes it; without rows in the end.
  std::optional<ModalBasis> open_basis;
  ModalResult modal;
  std::vector<double> mode_gaps;     ///< change of the gap of each contact row by each mode,
                                     ///< shape (modes, rows), see modes_at_contacts
  std::vector<BeamWaves> beams;      ///< of its regions of beams
  std::optional<StepDesign> design;  ///< if its time step has a target
  std::optional<LargestCompression> compression;  ///< under its weight, with P-Delta at full order
  StructureLimits limits;
  double energy_margin = 0;  ///< of the time step in force [-]

  /// The structure at full order: the design for its step, if that has a target, else as asked for.
  const Structure& full_order() const { return design ? design->structure : *structure; }
  const std::string& name() const { return system->name; }
  const ModalBasis* basis_or_null() const { return basis ? &*basis : nullptr; }
  /// Where the largest of a value per owned dof is: a place, or a generalised coordinate. The same
  /// on all ranks. Collective.
  std::string locate_largest(std::span<const double> values) const;
};

/// One side of a joint: how far its modes let it move along the normal.
struct SeparationSide {
  std::string structure;  ///< "wall" for a rigid one
  double peak = 0;        ///< largest of all pairs [m]
  int modes = 0;
  double frequency = 0;  ///< of the mode that moves it most [Hz]
  double ratio = 0;      ///< its damping ratio [-]
};

/// The joint that a contact would need if nothing were to hit, by response spectrum: peaks of each
/// mode from the ground motion of the scene, combined by their correlations (CQC), directions by
/// the root of the sum of squares. Each rule is the largest of all pairs of the contact.
struct Separation {
  std::size_t contact = 0;  ///< of the scene
  SeparationSide secondary, primary;
  double gap = 0;          ///< at rest, the smallest [m]
  double sum = 0;          ///< u1 + u2 [m]
  double srss = 0;         ///< sqrt(u1^2 + u2^2): EN 1998-1 4.4.2.7, ASCE 7-16 12.12.3 [m]
  double ddc = 0;          ///< sqrt(u1^2 + u2^2 - 2 rho u1 u2), rho below [m]
  double modal = 0;        ///< CQC over the modes of both, the second's with the other sign [m]
  double correlation = 0;  ///< of the two modes that move the sides most [-]
};

/// Gaps of the pairs of a contact before the run, the smallest and the largest [m].
struct JointGaps {
  std::array<double, 2> unloaded{};  ///< of undeformed structures
  std::array<double, 2> at_rest{};   ///< at the rest that the run starts from; the same without one
};

/// Everything about a scene that is constant in time, on this rank.
struct Model {
  std::vector<Mesh> meshes;  ///< per structure, one after the other for the scheme
  /// Numbers of the nodes in the mesh file, per structure, by file order; on rank 0, where matrices
  /// are exported and the mesh was read whole.
  std::vector<std::vector<std::int64_t>> node_tags;
  std::vector<LinearSystem> systems;  ///< per structure
  std::vector<Building> buildings;    ///< per structure: these two and findings about them
  interactions::Interface interface;  ///< reports on rank 0 only
  std::vector<ResolvedProbe> probes;
  std::vector<ResolvedProbe> recorded;  ///< probes, and rotations at the ends of spans
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

/// Reads the motions of ground and supports and the histories of loads of a scene into its model.
/// Throws UserError as they do. Every rank may do so.
void read_histories(const Scene& scene, Model& model);

}  // namespace pounding
