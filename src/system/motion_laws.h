#pragma once

#include <string>
#include <vector>

#include "interactions/laws/element_law.h"
#include "interactions/laws/hysteretic_law.h"
#include "system/element_products.h"

namespace pounding {

/// A motion of the nodes of an element, and the law in one dimension that it follows.
struct LawMotion {
  std::vector<double> shape;  ///< its elongation is shape . u, in the units of `law`
  double stiffness = 0;       ///< that K has for it, with which the element's energy holds it apart
  interactions::HystereticLaw law;
  double measure = 1;  ///< force of the law over that of PartState

  double elongation(std::span<const double> u) const {
    double sum = 0;
    for (std::size_t i = 0; i < shape.size(); ++i) sum += shape[i] * u[i];
    return sum;
  }
};

/// Elements of K u of which some motions b_m follow a law in one dimension each instead,
///
///     f = K u + sum b_m (N_m(b_m . u) - k_m b_m . u),        W_n = sum (1/2 N_m e_m - S_m)
///
/// S_m the energy that the law holds. K less all of the k_m b_m b_m^T must be positive semidefinite
/// for the stable step to be that of K.
class MotionLaws final : public interactions::ElementLaw {
 public:
  /// Laws by name, the same ones of each element to come; only the rules of `laws` count.
  MotionLaws(std::vector<std::string> names, std::span<const Hysteresis* const> laws);

  /// Adds an element with one motion per name, whose K is `stiffness`, of any size.
  void add(std::vector<LawMotion> own, std::span<const double> stiffness);

  std::size_t memory_size() const override { return begin_.back(); }
  double respond(std::size_t element, std::span<const double> displacement,
                 std::span<double> memory, std::span<double> force) const override;
  std::vector<std::string> parts() const override { return names_; }
  interactions::PartState part(std::size_t element, std::size_t number,
                               std::span<const double> memory) const override;

 private:
  std::vector<std::string> names_;
  std::vector<LawMotion> motions_;  ///< shape (elements, parts)
  ElementProducts products_;
  std::vector<std::size_t> begin_;  ///< of each part in a memory, and the end
};

}  // namespace pounding
