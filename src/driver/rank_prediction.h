#pragma once

#include <optional>

#include <mpi.h>

#include "common/profile.h"
#include "driver/rank_loads.h"
#include "scene/scene.h"

namespace pounding {

struct Model;

/// A step on ranks that are not there, added up for the rank that has most of each, nothing
/// overlapping: the step as measured, in proportion to the cost of the elements held; messages of
/// the halo of their mean length; log2(interface ranks) latencies of the contact and three values
/// of each of its dofs once.
struct RankPrediction {
  ForeseenLoads loads;
  double latency = 0;          ///< [s]
  double bandwidth = 0;        ///< [B/s]
  double measured = 0;         ///< step on the ranks at hand [s]
  double elements = 0;         ///< [s]
  double halo = 0;             ///< [s]
  double contact = 0;          ///< [s]
  double memory = 0;           ///< of a rank while it steps [bytes]
  double memory_now = 0;       ///< of the largest at hand, likewise [bytes]
  double start_up_memory = 0;  ///< of rank 0, which reads and cuts the meshes [bytes]

  double step() const { return elements + halo + contact; }
};

/// `measured`: of a step on the ranks at hand [s]; `memory_before`: of this rank before the model
/// was built [bytes]. Nothing if nothing was asked for. On rank 0. Collective.
std::optional<RankPrediction> predict_step(MPI_Comm comm, const Scene& scene, const Model& model,
                                           const Profile& profile, double measured,
                                           double memory_before);

}  // namespace pounding
