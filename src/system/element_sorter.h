#pragma once

#include <map>
#include <utility>
#include <vector>

#include "mesh/mesh.h"
#include "scene/scene.h"
#include "system/beam_elements.h"
#include "system/brick_lines.h"
#include "system/element_loop.h"
#include "system/element_shapes.h"
#include "system/element_stiffness.h"

namespace pounding {

/// Sorts the elements of a rank by how their product is done best. Local.
class ElementSorter {
 public:
  /// References must outlive this object.
  ElementSorter(const Structure& structure, const Mesh& mesh, const ElementShapes& shapes,
                const Halo& halo);

  void sort();

  /// What came out; `outer`: elements that touch a ghost. Call in this order; rows are formed here,
  /// and bricks that fit in none join the others.
  std::vector<BrickLines> brick_lines(bool outer);
  std::vector<CongruentElements> congruent_elements(bool outer) const;
  /// Beams between nodes that are free or clamped in all six components; `idle` as there.
  BeamElements beam_elements(bool outer, LocalIndex idle) const;
  /// Owned dofs of those beams, some more than once.
  std::vector<LocalIndex> beam_dofs(bool outer) const;
  SparseRows sparse_rows() const;
  ElementKinds kinds() const;

 private:
  /// An element of the mesh: block, place in the block.
  using Element = std::pair<std::size_t, std::size_t>;
  /// Bricks of one frame, with or without ghosts.
  struct BrickSet {
    std::vector<BrickElement> bricks;
    std::vector<Element> elements;
  };
  struct Congruent {
    std::vector<double> stiffness;
    std::array<std::vector<CongruentElements::Places>, 2> places;  ///< inner, outer
    std::vector<Element> elements;
  };

  void sort_hexahedra(std::size_t block);
  bool add_brick(const Element& element, const ElementProperties& properties);
  bool add_beam(const Element& element);
  int shape_number(const BrickShape& shape, std::size_t block);
  void add_congruent(const Element& element, const ElementProperties& properties);
  void demote_rare_shapes();
  bool touches_ghost(const Element& element) const;
  CongruentElements::Places places(const Element& element) const;

  const Structure& structure_;
  const Mesh& mesh_;
  const ElementShapes& element_shapes_;
  DofPlaces places_;
  mutable ElementWork work_;
  std::vector<BrickShape> shapes_;
  std::map<std::pair<std::size_t, Vector3>, int> shape_numbers_;  ///< -1: does not split
  std::array<std::map<int, BrickSet>, 2> brick_sets_;             ///< inner, outer; by frame
  std::map<std::pair<std::size_t, std::array<double, 24>>, Congruent> congruent_;
  std::array<std::vector<Element>, 2> beams_;  ///< inner, outer
  std::vector<Element> others_;
};

}  // namespace pounding
