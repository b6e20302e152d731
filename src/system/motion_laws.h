#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "laws/element_law.h"
#include "laws/hysteretic_law.h"
#include "scene/law_kinds.h"

namespace pounding {

/// A motion of the nodes of an element, and the law in one dimension that it follows.
struct LawMotion {
  std::vector<double> shape;  ///< its elongation is shape . u, in the units of `law`
  /// Law of the motion, which many elements may share. The first slope times `measure` is the
  /// stiffness that K has for the motion.
  std::shared_ptr<const interactions::HystereticLaw> law;
  double measure = 1;     ///< force and energy of the element over those of the law: a volume, say
  bool weakened = false;  ///< by the axial force
};

/// Axial force that takes from the strength of other motions of an element.
struct AxialWeakening {
  std::vector<double> shape;  ///< N = shape . u [N/m]
  double strength = 0;        ///< N_y [N]
  double exponent = 1;        ///< a

  double left(std::span<const double> displacement) const;
};

/// Elements of which some motions b_m follow a law in one dimension each, where K has a stiffness
/// k_m,
///
///     g = sum b_m (N_m(b_m . u) - k_m b_m . u),        W_n = sum (1/2 N_m e_m - S_m)
///
/// S_m the energy that the law holds; of a law by volume, N_m, k_m and S_m are those of all of it.
/// Where elements have an axial force N, some of the laws follow their strength by
/// 1 - (|N| / N_y)^a, a thousandth at least. K less all of the k_m b_m b_m^T must be positive
/// semidefinite for the stable step to be that of K. Where K holds nothing of them g has all of
/// N_m, and the stable step is that of K with all of the k_m b_m b_m^T.
class MotionLaws final : public interactions::ElementLaw {
 public:
  /// Laws of each element to come, of which only the names and rules count. `whole`: K holds
  /// nothing of them.
  MotionLaws(std::span<const OwnLaw> laws, bool whole);

  /// Adds an element with one motion per name. `axial`: of every element, or of none.
  void add(std::vector<LawMotion> own, std::optional<AxialWeakening> axial = {});

  std::size_t memory_size() const override { return begin_.back(); }
  bool acts_on(std::size_t element, std::size_t dof) const override;
  Response respond(std::size_t element, std::span<const double> displacement,
                   std::span<double> memory, std::span<double> force) const override;
  void add_tangent(std::size_t element, double factor, std::span<double> matrix) const override;
  std::vector<std::string> parts() const override { return names_; }
  double ductility(std::size_t element, std::size_t number,
                   std::span<const double> memory) const override;
  interactions::PartState part(std::size_t element, std::size_t number,
                               std::span<const double> memory) const override;

 private:
  /// A LawMotion whose shape is in `shapes_` from `shape` on, as the step reads them.
  struct Motion {
    std::shared_ptr<const interactions::HystereticLaw> law;
    std::size_t shape = 0;
    double measure = 1;
    bool weakened = false;
  };

  std::span<const double> own(std::size_t part, std::span<const double> memory) const {
    return memory.subspan(begin_[part], begin_[part + 1] - begin_[part]);
  }

  std::vector<std::string> names_;
  bool whole_;
  std::vector<Motion> motions_;        ///< shape (elements, parts)
  std::vector<double> shapes_;         ///< one after another, as long as their elements have dofs
  std::vector<AxialWeakening> axial_;  ///< per element, or empty
  std::vector<std::size_t> begin_;     ///< of each part in a memory, and the end
};

}  // namespace pounding
