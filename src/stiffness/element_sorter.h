#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "mesh/halo.h"
#include "mesh/mesh.h"
#include "scene/scene.h"
#include "stiffness/assembled_rows.h"
#include "stiffness/beam_elements.h"
#include "stiffness/bricks/brick_lines.h"
#include "stiffness/element_loop.h"
#include "stiffness/element_shapes.h"
#include "stiffness/rows/product.h"
#include "stiffness/shells/shell_lines.h"
#include "stiffness/strain_sorter.h"

namespace pounding::stiffness {

/// Sorts the elements of a rank by how their product is done best. Local.
class ElementSorter {
 public:
  /// References must outlive this object.
  ElementSorter(const Structure& structure, const Mesh& mesh, const ElementShapes& shapes,
                const Halo& halo, const ProductForms& forms);

  void sort();

  /// Results of `sort`; `outer`: elements that touch a ghost. Call in this order; rows are formed
  /// here, and elements that fit in none join the others.
  std::vector<std::unique_ptr<ElementLines>> element_lines(bool outer);
  template <template <typename> typename Of>
  GeneralElementsOf<Of> general_elements(bool outer) const {
    return general_.elements<Of>(outer, slots_);
  }
  /// Owned dofs of those, some more than once.
  std::vector<LocalIndex> general_dofs(bool outer) const { return general_.dofs(outer, slots_); }
  /// Beams between nodes that are free or clamped in all six components; `idle` as there.
  BeamElements beam_elements(bool outer, LocalIndex idle) const;
  /// Beams of a rank without ghosts, for eight runs.
  BatchElements<BeamShape> batch_beams() const;
  /// Owned dofs of those beams, some more than once.
  std::vector<LocalIndex> beam_dofs(bool outer) const;
  AssembledRows assembled_rows() const;
  ElementKinds kinds() const;

 private:
  /// An element of the mesh: block, slot in the block.
  using Element = std::pair<std::size_t, std::size_t>;
  /// Elements that may stand in rows together, with `lines` edges along a row.
  template <std::size_t lines>
  struct RowSet {
    std::vector<RowElement<lines>> rows;
    std::vector<Element> elements;
  };
  using Slots = std::array<LocalIndex, max_element_size>;  ///< as in DofSlots

  void sort_shapes(std::size_t block);
  bool add_brick(const Element& element, const ElementProperties& properties);
  bool add_rectangle(const Element& element, const ElementProperties& properties);
  bool add_beam(const Element& element);
  int brick_shape(const BrickShape& shape, std::size_t block);
  int rectangle_shape(const RectangleShape& shape, std::size_t block);
  void add_general(const Element& element);
  template <std::size_t lines>
  ElementRows<lines> form_rows(RowSet<lines>& set);
  std::array<double, BeamShape::number_count> beam_numbers(const Element& element) const;
  bool touches_ghost(const Element& element) const;
  Slots slots(const Element& element) const;

  const Structure& structure_;
  const Mesh& mesh_;
  const ElementShapes& element_shapes_;
  ProductForms forms_;
  DofSlots slots_;
  mutable ElementWork work_;
  std::vector<BrickShape> brick_shapes_;
  std::vector<RectangleShape> rectangle_shapes_;
  std::map<std::pair<std::size_t, Vector3>, int> shape_numbers_;  ///< -1: does not split
  /// Inner, outer; by frame, and by frame and normal.
  std::array<std::map<int, RowSet<4>>, 2> brick_sets_;
  std::array<std::map<std::pair<int, int>, RowSet<2>>, 2> rectangle_sets_;
  StrainSorter general_;
  std::array<std::vector<Element>, 2> beams_;  ///< inner, outer
  std::vector<Element> others_;
};

}  // namespace pounding::stiffness
