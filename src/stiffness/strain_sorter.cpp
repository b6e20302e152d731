#include "stiffness/strain_sorter.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "mesh/element_properties.h"
#include "stiffness/single_stiffness.h"

namespace pounding::stiffness {
namespace {

/// Positions along a space-filling curve: what is close there is close in space. By the bits of the
/// three coordinates in turns.
class SpaceCurve {
 public:
  explicit SpaceCurve(const Mesh& mesh) : mesh_(mesh) {
    low_.fill(INFINITY);
    double extent = 0;
    for (LocalIndex node = 0; node < mesh.node_count(); ++node) {
      const Vector3 x = mesh.position(node);
      for (std::size_t d = 0; d < 3; ++d) low_[d] = std::min(low_[d], x[d]);
    }
    for (LocalIndex node = 0; node < mesh.node_count(); ++node) {
      const Vector3 x = mesh.position(node);
      for (std::size_t d = 0; d < 3; ++d) extent = std::max(extent, x[d] - low_[d]);
    }
    scale_ = extent > 0 ? cells / extent : 0;
  }

  /// Position of the middle of some nodes.
  std::uint64_t position(std::span<const LocalIndex> nodes) const {
    std::uint64_t result = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      double sum = 0;
      for (const LocalIndex node : nodes) sum += mesh_.position(node)[d] - low_[d];
      const auto cell =
          static_cast<std::uint64_t>(sum / static_cast<double>(nodes.size()) * scale_);
      for (unsigned bit = 0; bit < bits; ++bit) result |= (cell >> bit & 1) << (3 * bit + d);
    }
    return result;
  }

 private:
  static constexpr unsigned bits = 20;
  static constexpr double cells = (1 << bits) - 1;

  const Mesh& mesh_;
  Vector3 low_{};
  double scale_ = 0;
};

}  // namespace

bool StrainSorter::add(std::size_t block, std::size_t element, bool outer) {
  switch (traits_of(mesh_.blocks[block].type).kernel) {
    case ElementKernel::brick:
      return add_hexahedron(block, element, outer);
    case ElementKernel::rectangle:
      return add_to(kept_.quadrangles, block, element, outer);
    case ElementKernel::triangle:
      return add_to(kept_.triangles, block, element, outer);
    default:
      return false;
  }
}

template <typename Shape>
bool StrainSorter::add_to(Collection<Shape>& collection, std::size_t b, std::size_t e, bool outer) {
  element_shapes_.find_coordinates(b, e, work_);
  put(collection, b, e, outer, shape_of(collection, b));
  return true;
}

template <typename Shape>
void StrainSorter::put(Collection<Shape>& collection, std::size_t b, std::size_t e, bool outer,
                       std::size_t shape) {
  const ElementBlock& block = mesh_.blocks[b];
  typename StrainElements<Shape>::Element entry{shape, {}};
  std::copy_n(&block.connectivity[e * Shape::node_count], Shape::node_count, entry.nodes.begin());
  collection.elements[outer ? 1 : 0].push_back(entry);
  counted_ += block.counted[e];
}

/// Takes the coordinates of the mesh themselves: an assembled matrix rounds the very same numbers.
bool StrainSorter::add_single(std::size_t b, std::size_t e, bool outer) {
  const ElementBlock& block = mesh_.blocks[b];
  if (structure_.numbers != Numbers::in_single) return false;
  const auto coordinates = gather_coordinates(mesh_, block, e, work_);
  if (!may_round(block.type, coordinates)) return false;
  const std::size_t size = SingleHexahedron::size;
  const std::span<double> stiffness(work_.stiffness.data(), size * size);
  element_matrices(block.type, coordinates, element_properties(structure_.regions[block.region]),
                   stiffness, {work_.mass.data(), size});
  const auto numbers = SingleHexahedron::find(coordinates, stiffness);
  if (!numbers) return false;
  kept_.single_hexahedra.shapes.push_back(*numbers);
  put(kept_.single_hexahedra, b, e, outer, kept_.single_hexahedra.shapes.size() - 1);
  counted_single_ += block.counted[e];
  return true;
}

/// Extruded ones are turned: element matrices know no axes.
bool StrainSorter::add_hexahedron(std::size_t b, std::size_t e, bool outer) {
  element_shapes_.find_coordinates(b, e, work_);
  const auto coordinates = work_.coordinates;
  const auto extrusion = Extrusion::find({coordinates.data(), HexahedronStrains<true>::size});
  if (!extrusion) {
    counted_skew_ += mesh_.blocks[b].counted[e];
    return add_to(kept_.hexahedra, b, e, outer);
  }
  auto& collection = kept_.extruded[extrusion->axis];
  StrainElements<HexahedronStrains<true>>::Element entry{};
  for (std::size_t a = 0; a < entry.nodes.size(); ++a) {
    const std::size_t corner = extrusion->corners[a];
    entry.nodes[a] = mesh_.blocks[b].connectivity[8 * e + corner];
    for (std::size_t d = 0; d < 3; ++d) {
      work_.coordinates[3 * a + d] = coordinates[3 * corner + extrusion->direction(d)];
    }
  }
  entry.shape = shape_of(collection, b);
  collection.elements[outer ? 1 : 0].push_back(entry);
  counted_ += mesh_.blocks[b].counted[e];
  return true;
}

template <typename Shape>
std::size_t StrainSorter::shape_of(Collection<Shape>& collection, std::size_t b) {
  const ElementBlock& block = mesh_.blocks[b];
  const std::span<const double> coordinates(work_.coordinates.data(), 3 * Shape::node_count);
  const std::size_t fresh_number = collection.shapes.size();
  if (has_shape(block.type)) {
    const auto [found, fresh] = collection.shape_numbers.try_emplace(
        {b, std::vector<double>(coordinates.begin(), coordinates.end())}, fresh_number);
    if (!fresh) return found->second;
  }
  const std::span<double> stiffness(work_.stiffness.data(), Shape::size * Shape::size);
  element_matrices(block.type, coordinates, element_properties(structure_.regions[block.region]),
                   stiffness, {work_.mass.data(), Shape::size});
  collection.shapes.push_back(Shape::numbers(coordinates, stiffness));
  return fresh_number;
}

template <typename Elements, typename Shape>
Elements StrainSorter::in_order(const Collection<Shape>& collection, bool outer,
                                const DofSlots& slots) const {
  const auto& elements = collection.elements[outer ? 1 : 0];
  const SpaceCurve curve(mesh_);
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    order.push_back({curve.position(elements[e].nodes), e});
  }
  std::sort(order.begin(), order.end());
  std::vector<typename StrainElements<Shape>::Element> sorted;
  sorted.reserve(elements.size());
  for (const auto& [position, e] : order) sorted.push_back(elements[e]);
  return {collection.shapes, sorted, slots.owned_dofs, slots.of_node};
}

/// Nodes with their components in the order in which elements extruded along an axis see them.
DofSlots StrainSorter::seen_along(std::size_t axis, const DofSlots& slots) {
  const Extrusion extrusion{axis, {}};
  DofSlots seen;
  seen.owned_dofs = slots.owned_dofs;
  for (const auto& node : slots.of_node) {
    auto& turned = seen.of_node.emplace_back(node);
    for (std::size_t d = 0; d < 3; ++d) turned[d] = node[extrusion.direction(d)];
  }
  return seen;
}

template <template <typename> typename Of>
GeneralElementsOf<Of> StrainSorter::elements(bool outer, const DofSlots& slots) const {
  const auto extruded = [&](std::size_t axis) {
    return in_order<Of<HexahedronStrains<true>>>(kept_.extruded[axis], outer,
                                                 seen_along(axis, slots));
  };
  return {in_order<Of<HexahedronStrains<false>>>(kept_.hexahedra, outer, slots),
          in_order<Of<SingleHexahedron>>(kept_.single_hexahedra, outer, slots),
          {extruded(0), extruded(1), extruded(2)},
          in_order<Of<QuadrangleStrains>>(kept_.quadrangles, outer, slots),
          in_order<Of<TriangleStrains>>(kept_.triangles, outer, slots)};
}
template GeneralElementsOf<StrainElements> StrainSorter::elements(bool, const DofSlots&) const;
template GeneralElementsOf<BatchElements> StrainSorter::elements(bool, const DofSlots&) const;

std::vector<LocalIndex> StrainSorter::dofs(bool outer, const DofSlots& slots) const {
  std::vector<LocalIndex> dofs;
  GeneralElementsOf<Collection>::each(kept_, [&]<typename Shape>(const Collection<Shape>& all) {
    for (const auto& element : all.elements[outer ? 1 : 0]) {
      for (const LocalIndex node : element.nodes) {
        for (std::size_t c = 0; c < Shape::components; ++c) {
          const LocalIndex slot = slots.of_node[node][c];
          if (slot >= 0 && slot < slots.owned_dofs) dofs.push_back(slot);
        }
      }
    }
  });
  return dofs;
}

}  // namespace pounding::stiffness
