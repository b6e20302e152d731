#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include <mpi.h>

#include "common/saved_state.h"
#include "fidelity/probe_means.h"
#include "interactions/interface_rows.h"
#include "model/model.h"
#include "model/model_scheme.h"
#include "motion/ground_motion.h"
#include "scene/scene.h"

namespace pounding {

/// Time over which the ground's motion sets in at full order [s].
inline constexpr double fade_in = 0.1;

/// Motion of the reduced structures by themselves from the beginning of the window on.
class InheritedMotion {
 public:
  /// `first`: the last step before the window, in whose `state` it begins. Collective.
  InheritedMotion(MPI_Comm comm, const Scene& scene, const Model& model, std::int64_t first,
                  const SavedState& state, Profile& profile);

  /// When the window begins: the next step's time [s].
  double start() const { return static_cast<double>(first_ + 1) * model_.time_step; }
  std::size_t dofs() const { return rows_.dofs(); }
  /// Displacements of the interface's places at a time after the start [m].
  void places(double time, std::vector<double>& result);
  /// Makes the records until step `last` of the run.
  void finish(std::int64_t last) {
    while (scheme_.stepper().state().step <= last) step();
  }
  /// Velocities of the channels in every record from the window's first step on, this rank's part.
  const std::vector<double>& records() const { return records_; }

 private:
  ModelScheme::Parts parts(const Scene& scene, Profile& profile) const;
  void step();
  /// The places of the state, and how its velocity moves them for a while [s].
  void take_places(double duration);
  void record();

  MPI_Comm comm_;
  const Model& model_;
  int stride_;
  std::int64_t first_;
  GroundMotion motion_;
  interactions::Interface none_;
  ModelScheme scheme_;
  ProbeMeans means_;
  interactions::InterfaceRows rows_;
  std::deque<std::vector<double>> places_;
  std::int64_t front_ = -1;  ///< step after the start of the first of `places_`
  std::vector<double> records_;
};

}  // namespace pounding
