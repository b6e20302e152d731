#pragma once

#include <cstdint>
#include <string>

#include <mpi.h>

#include "model/model.h"
#include "observers/impact_catalogue.h"
#include "observers/recorder.h"
#include "scene/scene.h"

namespace pounding {

/// A part of a run, by steps that make records.
struct Window {
  std::int64_t first = 0;  ///< the last step before it
  std::int64_t last = 0;
  std::string reason{};
};

/// The window of so many seconds about the largest impulse of a run, or about the largest
/// acceleration of its probes where nothing was hit. Collective.
Window place_window(MPI_Comm comm, const Scene& scene, const Model& model,
                    const ImpactCatalogue& impacts, const Recorder& recorder, double length);

}  // namespace pounding
