#pragma once

#include <vector>

#include <mpi.h>

#include "common/saved_state.h"
#include "fidelity/window_place.h"
#include "model/model.h"
#include "model/model_scheme.h"
#include "scene/scene.h"

namespace pounding {

/// A part of a reduced run at full order: the motion that the reduced structures inherit, see
/// full_order_window.h, and from rest that of the same structures at full order. The model of
/// those is built once, and may be stepped by steps of several lengths.
class SteppedWindow {
 public:
  /// `scene`, `model`: of the reduced run, `state`: that in which the window begins; all of them
  /// outlive this object; `splits`: of the elements of its meshes. Throws UserError. Collective.
  SteppedWindow(MPI_Comm comm, const Scene& scene, const Model& model, const Window& window,
                const SavedState& state, int splits = 0);

  /// The motion of a window.
  struct Motion {
    std::vector<double> velocities;  ///< of the sum, shape (records, channels) [m/s]
    double impulse = 0;              ///< of all contacts [N s]
    double seconds = 0;              ///< that the steps at full order took
  };
  /// Steps it with the step of full order over `parts`. The same on every rank. Collective.
  Motion run(int parts) const;

  const Model& full() const { return full_; }
  /// When it begins and ends [s].
  double start() const { return static_cast<double>(window_.first + 1) * model_.time_step; }
  double end() const { return static_cast<double>(window_.last) * model_.time_step; }

 private:
  MPI_Comm comm_;
  const Scene& scene_;
  const Model& model_;
  const Window& window_;
  const SavedState& state_;
  mutable Profile profile_;
  Scene full_scene_;  ///< the model borrows from it
  Model full_;
};

/// A scene to be built anew beside its run, at a time step of its own: no outputs but probes.
void leave_outputs(Scene& scene);

/// Adds the impulses of the step just made to `sum`: those of rows that this rank counts.
void add_impulses(ModelScheme& scheme, double& sum);

}  // namespace pounding
