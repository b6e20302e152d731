#include "model/model.h"

#include "mesh/location.h"
#include "modal/reduced_system.h"

namespace pounding {

std::string Building::locate_largest(std::span<const double> values) const {
  return basis ? pounding::locate_largest(*system, *basis, values)
               : pounding::locate_largest(*mesh, values);
}

void read_histories(const Scene& scene, Model& model) {
  model.motion = std::make_unique<GroundMotion>(scene.motion, scene.resampling);
  if (scene.motion_from_below) model.motion->enter_from_below();
  if (!scene.motion_incoherent.empty()) {
    model.motion->add_incoherent(scene.motion_incoherent, scene.resampling);
  }
  if (!scene.supports.empty()) {
    model.supports =
        std::make_unique<SupportMotion>(scene.supports, *model.motion, scene.resampling);
  }
  if (!scene.loads.empty()) model.load_histories = std::make_unique<LoadHistories>(scene.loads);
}

}  // namespace pounding
