#include "system/motion_laws.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pounding {
namespace {

constexpr double least_strength = 1e-3;

/// Product a . b in four sums, which do not wait for each other.
inline double dot(std::span<const double> a, std::span<const double> b) {
  std::array<double, 4> sums{};
  std::size_t i = 0;
  for (; i + 4 <= a.size(); i += 4) {
    for (std::size_t k = 0; k < 4; ++k) sums[k] += a[i + k] * b[i + k];
  }
  for (; i < a.size(); ++i) sums[0] += a[i] * b[i];
  return (sums[0] + sums[2]) + (sums[1] + sums[3]);
}

}  // namespace

double AxialWeakening::left(std::span<const double> displacement) const {
  const double part = std::abs(dot(shape, displacement)) / strength;
  return std::max(least_strength, 1 - std::pow(part, exponent));
}

MotionLaws::MotionLaws(std::span<const OwnLaw> laws, bool whole) : whole_(whole), begin_{0} {
  for (const OwnLaw& own : laws) {
    names_.push_back(own.name);
    begin_.push_back(begin_.back() + interactions::HystereticLaw(own.law).memory_size());
  }
}

void MotionLaws::add(std::vector<LawMotion> own, std::optional<AxialWeakening> axial) {
  for (LawMotion& motion : own) {
    motions_.push_back({std::move(motion.law), shapes_.size(), motion.measure, motion.weakened});
    shapes_.insert(shapes_.end(), motion.shape.begin(), motion.shape.end());
  }
  if (axial) axial_.push_back(std::move(*axial));
}

bool MotionLaws::acts_on(std::size_t element, std::size_t dof) const {
  for (std::size_t m = 0; m < names_.size(); ++m) {
    if (shapes_[motions_[element * names_.size() + m].shape + dof] != 0) return true;
  }
  return !axial_.empty() && axial_[element].shape[dof] != 0;
}

interactions::ElementLaw::Response MotionLaws::respond(std::size_t element,
                                                       std::span<const double> displacement,
                                                       std::span<double> memory,
                                                       std::span<double> force) const {
  Response response;
  const double left = axial_.empty() ? 1 : axial_[element].left(displacement);
  for (std::size_t m = 0; m < names_.size(); ++m) {
    const Motion& motion = motions_[element * names_.size() + m];
    const interactions::HystereticLaw& law = *motion.law;
    const std::span<const double> along(&shapes_[motion.shape], displacement.size());
    const std::span<double> own = memory.subspan(begin_[m], begin_[m + 1] - begin_[m]);
    const double elongation = dot(along, displacement);
    law.advance(elongation, own, motion.weakened ? left : 1);
    const bool elastic = law.is_elastic(own);
    if (elastic && !whole_) continue;
    const double held = whole_ ? 0 : law.tangent() * elongation;
    const double less = motion.measure * (law.force(own) - held);
    for (std::size_t i = 0; i < force.size(); ++i) force[i] += less * along[i];
    response.offset += motion.measure * (law.force(own) * elongation / 2 - law.stored(own));
    response.acts = true;
    response.yields = response.yields || !elastic;
  }
  return response;
}

void MotionLaws::add_tangent(std::size_t element, double factor, std::span<double> matrix) const {
  for (std::size_t m = 0; whole_ && m < names_.size(); ++m) {
    const Motion& motion = motions_[element * names_.size() + m];
    const double stiffness = factor * motion.measure * motion.law->tangent();
    const double* const shape = &shapes_[motion.shape];
    const std::size_t dofs = shapes_.size() / motions_.size();
    for (std::size_t n = 0; n < matrix.size(); ++n) {
      matrix[n] += stiffness * shape[n / dofs] * shape[n % dofs];
    }
  }
}

double MotionLaws::ductility(std::size_t element, std::size_t number,
                             std::span<const double> memory) const {
  return motions_[element * names_.size() + number].law->ductility(own(number, memory));
}

interactions::PartState MotionLaws::part(std::size_t element, std::size_t number,
                                         std::span<const double> memory) const {
  const auto& [law, shape, measure, weakened] = motions_[element * names_.size() + number];
  const auto own = this->own(number, memory);
  return {law->elongation(own), law->force(own), law->ductility(own), measure * law->lost(own),
          measure * (law->lost(own) + law->stored(own))};
}

}  // namespace pounding
