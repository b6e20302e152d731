#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "interactions/pairing/interface.h"
#include "mesh/mesh.h"
#include "motion/ground_motion.h"
#include "motion/support_motion.h"
#include "system/linear_system.h"

namespace pounding::measuring {

/// Edges of the elements of bricks and plates; the last is the plate's thickness [m].
inline constexpr Vector3 cell_size{0.12, 0.12, 0.22};

/// What is to be stepped, and under which motion.
struct ModelRequest {
  std::array<int, 3> cells{};  ///< of one brick of concrete, clamped at its face x = 0; of a plate
                               ///< of shells if there are none along z; or
  int cells_per_metre = 0;     ///< of a pair of buildings, see storey_pair.h; or
  std::string scene;           ///< options file of the program, its motion included
  std::string motion;          ///< file of samples [m/s2], applied in all three directions
  double motion_step = 0;      ///< [s]
};

/// A model as the program has it when it starts to step, on this rank.
struct SteppedModel {
  MPI_Comm comm = MPI_COMM_SELF;
  std::vector<Structure> structures;
  std::vector<Mesh> meshes;
  std::vector<LinearSystem> systems;
  interactions::Interface interface;
  std::vector<Contact> contacts;  ///< of a scene
  std::unique_ptr<GroundMotion> motion;
  std::unique_ptr<SupportMotion> supports;  ///< of a scene; null where the ground moves as one
  double time_step = 0;                     ///< 0.9 of the one that single elements guarantee [s]

  GlobalIndex global_dofs() const;
};

/// Builds, partitions, distributes and assembles. Collective.
SteppedModel build_stepped_model(MPI_Comm comm, const ModelRequest& request,
                                 StiffnessMethod method);

}  // namespace pounding::measuring
