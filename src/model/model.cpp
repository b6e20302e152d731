#include "model/model.h"

#include "mesh/kept_inputs.h"
#include "mesh/location.h"
#include "modal/reduced_system.h"

namespace pounding {

std::string Building::locate_largest(std::span<const double> values) const {
  return basis ? pounding::locate_largest(*system, *basis, values)
               : pounding::locate_largest(*mesh, values);
}

namespace {

GroundMotion read_motion(const Scene& scene) {
  GroundMotion motion(scene.motion, scene.resampling);
  if (scene.motion_from_below) motion.enter_from_below();
  if (!scene.motion_incoherent.empty()) {
    motion.add_incoherent(scene.motion_incoherent, scene.resampling);
  }
  return motion;
}

}  // namespace

void read_histories(const Scene& scene, Model& model) {
  const bool kept = scene.kept && scene.kept->motion;
  model.motion = std::make_unique<GroundMotion>(kept ? *scene.kept->motion : read_motion(scene));
  if (scene.kept && !kept) scene.kept->motion = std::make_shared<GroundMotion>(*model.motion);
  if (!scene.supports.empty()) {
    model.supports =
        std::make_unique<SupportMotion>(scene.supports, *model.motion, scene.resampling);
  }
  if (!scene.loads.empty()) model.load_histories = std::make_unique<LoadHistories>(scene.loads);
}

}  // namespace pounding
