#include "system/motion_laws.h"

#include <utility>

namespace pounding {

MotionLaws::MotionLaws(std::vector<std::string> names, std::span<const Hysteresis* const> laws)
    : names_(std::move(names)), begin_{0} {
  for (const Hysteresis* const law : laws) {
    begin_.push_back(begin_.back() + interactions::HystereticLaw(*law).memory_size());
  }
}

void MotionLaws::add(std::vector<LawMotion> own, std::span<const double> stiffness) {
  for (LawMotion& motion : own) motions_.push_back(std::move(motion));
  products_.add(stiffness);
}

double MotionLaws::respond(std::size_t element, std::span<const double> displacement,
                           std::span<double> memory, std::span<double> force) const {
  products_.apply(element, displacement, force);
  double lost = 0;
  for (std::size_t m = 0; m < names_.size(); ++m) {
    const LawMotion& motion = motions_[element * names_.size() + m];
    const std::span<double> own = memory.subspan(begin_[m], begin_[m + 1] - begin_[m]);
    const double elongation = motion.elongation(displacement);
    motion.law.advance(elongation, own);
    const double less = motion.law.force(own) - motion.stiffness * elongation;
    for (std::size_t i = 0; i < force.size(); ++i) force[i] += less * motion.shape[i];
    lost += motion.law.force(own) * elongation / 2 - motion.law.stored(own);
  }
  return lost;
}

interactions::PartState MotionLaws::part(std::size_t element, std::size_t number,
                                         std::span<const double> memory) const {
  const LawMotion& motion = motions_[element * names_.size() + number];
  const interactions::HystereticLaw& law = motion.law;
  const auto own = memory.subspan(begin_[number], begin_[number + 1] - begin_[number]);
  return {law.elongation(own), law.force(own) / motion.measure, law.ductility(own), law.lost(own),
          law.lost(own) + law.stored(own)};
}

}  // namespace pounding
