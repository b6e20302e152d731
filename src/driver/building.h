#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "driver/beam_waves.h"
#include "interactions/pairing/absorbing_faces.h"
#include "mesh/connectivity.h"
#include "mesh/divide_beams.h"
#include "mesh/mesh.h"
#include "mesh/mesh_files.h"
#include "mesh/spread_springs.h"
#include "modal/modal_analysis.h"
#include "modal/modal_basis.h"
#include "scene/scene.h"
#include "stability/step_target.h"
#include "stability/structure_limits.h"
#include "system/element_forces.h"
#include "system/linear_system.h"

namespace pounding {

/// Findings of the checks of a structure's mesh.
struct MeshFindings {
  Connectivity connectivity;
  std::vector<UnusedElements> unused;  ///< places that no option of the scene names
  MeshFiles files;
  std::vector<DividedLines> divided;  ///< regions whose lines were cut into beams
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

}  // namespace pounding
