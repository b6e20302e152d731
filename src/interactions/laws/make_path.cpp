#include "interactions/laws/make_path.h"

#include "interactions/laws/isotropic_path.h"
#include "interactions/laws/peak_path.h"
#include "interactions/laws/slider_path.h"

namespace pounding::interactions {

std::unique_ptr<HysteresisPath> make_path(const Hysteresis& law) {
  if (law.rule == HystereticRule::kinematic) return std::make_unique<SliderPath>(law);
  if (law.rule == HystereticRule::isotropic) return std::make_unique<IsotropicPath>(law);
  return std::make_unique<PeakPath>(law);
}

}  // namespace pounding::interactions
