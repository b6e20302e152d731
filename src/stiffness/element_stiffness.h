#pragma once

#include <memory>
#include <vector>

#include "common/memory.h"
#include "mesh/halo.h"
#include "mesh/mesh.h"
#include "scene/scene.h"
#include "stiffness/assembled_rows.h"
#include "stiffness/beam_elements.h"
#include "stiffness/rows/product.h"
#include "stiffness/stiffness.h"

namespace pounding::stiffness {

struct GeneralElements;

/// K applied element by element, without reading a matrix: bricks and rectangles share theirs,
/// others bring the numbers of their strains. A rank holds every element that touches an owned
/// node, so a product needs the ghosts of w once; they travel while the elements without ghosts are
/// done:
///
///     w -> [halo begins] -> sparse rows, general, rows -> [halo ends] -> those with ghosts
///
/// Forces that nothing adds to any more are handed over at once, the others at the end. Each rank
/// sums in a fixed order: the same bits on every run. Against the assembled matrix the product
/// differs by round-off, and by the 1e-10 of the shortest edge to which shapes count as congruent.
class ElementStiffness final : public Stiffness {
 public:
  /// `assembled` lends its matrix to those who ask for it; may be null, then matrix() is.
  /// Collective.
  ElementStiffness(const Structure& structure, const Mesh& mesh,
                   std::shared_ptr<Stiffness> assembled, const ProductForms& forms = {});
  ~ElementStiffness() override;

  using Stiffness::apply;
  void start(const StiffnessArgument& w) const override { halo_->begin(w); }
  void finish(const StiffnessArgument& w, ForceReceiver& receiver) const override;
  void apply(Vec w, Vec q) const override;
  /// q = K w on arrays of owned dofs. Collective.
  void apply(const double* w, double* q) const;
  Mat matrix() const override { return assembled_ != nullptr ? assembled_->matrix() : nullptr; }
  void release_matrix() override { assembled_.reset(); }

  const ElementKinds& kinds() const { return kinds_; }

 private:
  /// Everything applied before, or after the ghosts are here.
  struct Part {
    std::vector<std::unique_ptr<ElementLines>> lines;  ///< bricks and rectangles in rows
    std::unique_ptr<GeneralElements> general;
    std::unique_ptr<BeamElements> beams;
    std::vector<LocalIndex> dofs;  ///< owned, of all but the rows; some more than once
  };
  void plan();
  void add_general(const Part& part) const;
  StiffnessArgument relative_to_origin(StiffnessArgument w) const;

  LocalIndex owned_dofs_ = 0;
  LocalIndex origin_dof_ = -1;  ///< first of x, y, z of a node that moves freely; -1: there is none
  std::shared_ptr<Stiffness> assembled_;
  std::unique_ptr<Halo> halo_;
  Part inner_;                             ///< elements of owned nodes only
  Part outer_;                             ///< elements that touch a ghost
  std::unique_ptr<AssembledRows> sparse_;  ///< all others
  std::vector<DofRange> general_ranges_;   ///< owned dofs that others than rows read
  std::vector<DofRange> late_ranges_;      ///< owned dofs that rows do not hand over
  ElementKinds kinds_;
  /// Owned dofs, ghosts, and six dofs that stay at rest for the slots of clamped nodes.
  ZeroedArray argument_;  ///< w in general_ranges_, and ghosts
  ZeroedArray force_;     ///< of owned dofs zero between products
};

}  // namespace pounding::stiffness
