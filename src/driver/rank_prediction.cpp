#include "driver/rank_prediction.h"

#include <algorithm>
#include <cmath>

#include "common/memory_use.h"
#include "common/parallel.h"
#include "driver/model.h"

namespace pounding {
namespace {

constexpr double value_bytes = sizeof(double);
constexpr double gathered_values = 3;  ///< per dof of a contact: u, v-, v_free

}  // namespace

std::optional<RankPrediction> predict_step(MPI_Comm comm, const Scene& scene, const Model& model,
                                           const Profile& profile, double measured,
                                           double memory_before) {
  if (scene.predict_ranks == 0) return std::nullopt;
  const double held = take_memory_use().held;
  double grown = held - memory_before;
  MPI_Allreduce(MPI_IN_PLACE, &grown, 1, MPI_DOUBLE, MPI_SUM, comm);
  double largest[2] = {held, memory_before};
  MPI_Allreduce(MPI_IN_PLACE, largest, 2, MPI_DOUBLE, MPI_MAX, comm);
  if (rank_of(comm) != 0) return std::nullopt;
  RankPrediction prediction;
  prediction.loads = model.foreseen.value();
  const auto& [now, then] = prediction.loads;
  prediction.latency = scene.latency;
  prediction.bandwidth = scene.bandwidth;
  prediction.measured = measured;
  prediction.elements =
      now.cost > 0 ? measured * static_cast<double>(then.cost) / static_cast<double>(now.cost)
                   : measured;  // reduced structures are not cut
  prediction.halo = static_cast<double>(then.messages) * scene.latency +
                    value_bytes * static_cast<double>(then.exchanged) / scene.bandwidth;
  if (then.interface_ranks > 1) {
    prediction.contact =
        std::ceil(std::log2(then.interface_ranks)) * scene.latency +
        value_bytes * gathered_values * static_cast<double>(then.interface_dofs) / scene.bandwidth;
  }
  const double per_dof = grown / static_cast<double>(std::max<std::int64_t>(1, now.all_held_dofs));
  prediction.memory = largest[1] + per_dof * static_cast<double>(then.held_dofs);
  prediction.memory_now = largest[0];
  prediction.start_up_memory =
      std::max(profile.memory(Phase::mesh).peak, profile.memory(Phase::partition).peak);
  return prediction;
}

}  // namespace pounding
