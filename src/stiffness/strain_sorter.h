#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "mesh/mesh.h"
#include "scene/scene.h"
#include "stiffness/element_loop.h"
#include "stiffness/element_shapes.h"
#include "stiffness/rows/product.h"
#include "stiffness/strains/batch_elements.h"
#include "stiffness/strains/hexahedron_strains.h"
#include "stiffness/strains/shell_strains.h"
#include "stiffness/strains/single_hexahedron.h"
#include "stiffness/strains/strain_elements.h"

namespace pounding::stiffness {

/// Elements of every kind that is applied by its strains; `Of`: StrainElements or BatchElements.
template <template <typename> typename Of>
struct GeneralElementsOf {
  Of<HexahedronStrains<false>> hexahedra;
  Of<SingleHexahedron> single_hexahedra;
  std::array<Of<HexahedronStrains<true>>, 3> extruded;  ///< along x, y, z
  Of<QuadrangleStrains> quadrangles;
  Of<TriangleStrains> triangles;

  /// Calls `visit` with those of each kind.
  static void each(auto& all, const auto& visit) {
    visit(all.hexahedra);
    visit(all.single_hexahedra);
    for (auto& elements : all.extruded) visit(elements);
    visit(all.quadrangles);
    visit(all.triangles);
  }
};

/// Applied to one run.
struct GeneralElements : GeneralElementsOf<StrainElements> {
  /// q += K w; both arrays hold all slots. Allocates nothing.
  void apply(const double* w, double* q) const {
    each(*this, [&](const auto& elements) { elements.apply(w, q); });
  }
};

/// Collects the elements of a rank that are applied by their strains. Local.
class StrainSorter {
 public:
  /// References must outlive this object.
  StrainSorter(const Structure& structure, const Mesh& mesh, const ElementShapes& shapes)
      : structure_(structure), mesh_(mesh), element_shapes_(shapes) {}

  /// Keeps a linear element of a block; `outer`: it touches a ghost. False for other kinds.
  bool add(std::size_t block, std::size_t element, bool outer);
  /// Keeps an element whose numbers are rounded to 32 bits; false for others.
  bool add_single(std::size_t block, std::size_t element, bool outer);

  /// Results of `add`.
  template <template <typename> typename Of>
  GeneralElementsOf<Of> elements(bool outer, const DofSlots& slots) const;
  /// Owned dofs of the elements, some more than once.
  std::vector<LocalIndex> dofs(bool outer, const DofSlots& slots) const;
  /// Elements that this rank counts.
  GlobalIndex counted() const { return counted_; }
  GlobalIndex counted_single() const { return counted_single_; }
  GlobalIndex counted_skew() const { return counted_skew_; }

 private:
  template <typename Shape>
  struct Collection {
    std::vector<typename StrainElements<Shape>::Numbers> shapes;
    /// Elements in the same block with the same coordinates share one.
    std::map<std::pair<std::size_t, std::vector<double>>, std::size_t> shape_numbers;
    std::array<std::vector<typename StrainElements<Shape>::Element>, 2> elements;  ///< inner, outer
  };
  /// Keeps an element of a shape.
  template <typename Shape>
  void put(Collection<Shape>& collection, std::size_t block, std::size_t element, bool outer,
           std::size_t shape);
  template <typename Shape>
  bool add_to(Collection<Shape>& collection, std::size_t block, std::size_t element, bool outer);
  bool add_hexahedron(std::size_t block, std::size_t element, bool outer);
  /// The shape with these coordinates, which `work_` holds; those that the elements of a block may
  /// share are kept.
  template <typename Shape>
  std::size_t shape_of(Collection<Shape>& collection, std::size_t block);
  static DofSlots seen_along(std::size_t axis, const DofSlots& slots);
  template <typename Elements, typename Shape>
  Elements in_order(const Collection<Shape>& collection, bool outer, const DofSlots& slots) const;

  const Structure& structure_;
  const Mesh& mesh_;
  const ElementShapes& element_shapes_;
  ElementWork work_;
  GeneralElementsOf<Collection> kept_;
  GlobalIndex counted_ = 0;
  GlobalIndex counted_single_ = 0;  ///< of these
  GlobalIndex counted_skew_ = 0;    ///< hexahedra among these that are not extruded
};

}  // namespace pounding::stiffness
