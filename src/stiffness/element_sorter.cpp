#include "stiffness/element_sorter.h"

#include <algorithm>

#include "elements/geometric_stiffness.h"
#include "mesh/element_properties.h"
#include "stiffness/bricks/brick_stencil.h"
#include "stiffness/shells/shell_kernel.h"
#include "stiffness/single_stiffness.h"

namespace pounding::stiffness {
namespace {

/// The sets of a map with their keys, the largest first.
template <typename Key, typename Set>
std::vector<std::pair<Key, Set*>> largest_first(std::map<Key, Set>& sets) {
  std::vector<std::pair<Key, Set*>> sorted;
  sorted.reserve(sets.size());
  for (auto& [key, set] : sets) sorted.push_back({key, &set});
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return a.second->elements.size() > b.second->elements.size();
  });
  return sorted;
}

}  // namespace

ElementSorter::ElementSorter(const Structure& structure, const Mesh& mesh,
                             const ElementShapes& shapes, const Halo& halo,
                             const ProductForms& forms)
    : structure_(structure),
      mesh_(mesh),
      element_shapes_(shapes),
      forms_(forms),
      general_(structure, mesh, shapes) {
  slots_.owned_dofs = mesh.owned_dofs;
  slots_.of_dof.resize(mesh.dof_count);
  for (LocalIndex dof = 0; dof < mesh.dof_count; ++dof) {
    slots_.of_dof[dof] =
        dof < mesh.owned_dofs
            ? dof
            : mesh.owned_dofs + halo.slot(static_cast<std::size_t>(dof - mesh.owned_dofs));
  }
  for (LocalIndex node = 0; node < mesh.node_count(); ++node) {
    slots_.of_node.emplace_back().fill(-1);
    if (node < mesh.owned_nodes) {
      const std::size_t n = node;
      slots_.node_end.push_back(mesh.first_dof[n] + component_count(mesh.free_components[n]));
    }
  }
  for_each_dof(mesh, 0, mesh.node_count(), [&](LocalIndex dof, LocalIndex node, int c) {
    slots_.of_node[node][c] = slots_.of_dof[dof];
  });
}

void ElementSorter::sort() {
  for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
    if (has_shape(mesh_.blocks[b].type)) {
      sort_shapes(b);
    } else if (is_in_stiffness(mesh_.blocks[b].type)) {
      for (std::size_t e = 0; e < mesh_.blocks[b].count(); ++e) {
        if (!add_beam({b, e})) add_general({b, e});
      }
    }
  }
}

void ElementSorter::sort_shapes(std::size_t b) {
  const ElementBlock& block = mesh_.blocks[b];
  const ElementProperties properties = element_properties(structure_.regions[block.region]);
  for (std::size_t e = 0; e < block.count(); ++e) {
    if (general_.add_single(b, e, touches_ghost({b, e}))) continue;
    const bool in_row =
        is_solid(block.type) ? add_brick({b, e}, properties) : add_rectangle({b, e}, properties);
    if (!in_row) add_general({b, e});
  }
}

bool ElementSorter::add_brick(const Element& element, const ElementProperties& properties) {
  const auto [b, e] = element;
  const ElementBlock& block = mesh_.blocks[b];
  const Box* const brick = element_shapes_.box(b, e);
  if (brick == nullptr || !forms_.bricks) return false;
  const int number = brick_shape({block.type, properties, brick->lengths}, b);
  if (number < 0) return false;
  BrickElement entry{number, {}};
  for (std::size_t corner = 0; corner < 8; ++corner) {
    entry.nodes[corner] =
        block.connectivity[8 * e + static_cast<std::size_t>(brick->corner[corner])];
  }
  RowSet<4>& set = brick_sets_[touches_ghost(element) ? 1 : 0][brick->frame];
  set.rows.push_back(entry);
  set.elements.push_back(element);
  return true;
}

bool ElementSorter::add_rectangle(const Element& element, const ElementProperties& properties) {
  const auto [b, e] = element;
  const Box* const box = element_shapes_.box(b, e);
  if (box == nullptr || !forms_.rectangles) return false;
  const auto first = static_cast<std::size_t>(box->normal + 1) % 3;
  const auto second = static_cast<std::size_t>(box->normal + 2) % 3;
  const int number = rectangle_shape({properties, {box->lengths[first], box->lengths[second]}}, b);
  if (number < 0) return false;
  RectangleElement entry{number, {}};
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const std::size_t bits = (corner & 1) << first | (corner >> 1) << second;
    entry.nodes[corner] =
        mesh_.blocks[b].connectivity[4 * e + static_cast<std::size_t>(box->corner[bits])];
  }
  RowSet<2>& set = rectangle_sets_[touches_ghost(element) ? 1 : 0][{box->frame, box->normal}];
  set.rows.push_back(entry);
  set.elements.push_back(element);
  return true;
}

bool ElementSorter::add_beam(const Element& element) {
  const ElementBlock& block = mesh_.blocks[element.first];
  if (!forms_.beams || !is_beam(block.type) || !block.axial_force.empty()) return false;
  const auto slot = slots(element);
  for (std::size_t i = 1; i < 12; ++i) {
    // Six dofs in a row, or none.
    const LocalIndex first = slot[i - i % 6];
    if (slot[i] != (first < 0 ? -1 : first + static_cast<LocalIndex>(i % 6))) return false;
  }
  beams_[touches_ghost(element) ? 1 : 0].push_back(element);
  return true;
}

int ElementSorter::brick_shape(const BrickShape& shape, std::size_t block) {
  const auto [found, fresh] = shape_numbers_.try_emplace({block, shape.lengths}, -1);
  if (fresh && split_brick(shape.type, shape.properties, shape.lengths)) {
    found->second = static_cast<int>(brick_shapes_.size());
    brick_shapes_.push_back(shape);
  }
  return found->second;
}

int ElementSorter::rectangle_shape(const RectangleShape& shape, std::size_t block) {
  const Vector3 key{shape.lengths[0], shape.lengths[1], 0};
  const auto [found, fresh] = shape_numbers_.try_emplace({block, key}, -1);
  if (fresh && split_rectangle(shape.properties, shape.lengths, 0)) {
    found->second = static_cast<int>(rectangle_shapes_.size());
    rectangle_shapes_.push_back(shape);
  }
  return found->second;
}

void ElementSorter::add_general(const Element& element) {
  const auto [b, e] = element;
  const bool general = forms_.strains && general_.add(b, e, touches_ghost(element));
  if (!general) others_.push_back(element);
}

/// Elements that fit in no row leave the set for those of general shape.
template <std::size_t lines>
ElementRows<lines> ElementSorter::form_rows(RowSet<lines>& set) {
  ElementRows<lines> rows = best_rows(set.rows, mesh_.node_count());
  std::vector<Element> kept;
  auto left = rows.left_over.begin();
  for (std::size_t e = 0; e < set.elements.size(); ++e) {
    const bool out = left != rows.left_over.end() && *left == e;
    if (out) {
      add_general(set.elements[e]);
      ++left;
    } else {
      kept.push_back(set.elements[e]);
    }
  }
  set.elements = std::move(kept);
  return rows;
}

std::vector<std::unique_ptr<ElementLines>> ElementSorter::element_lines(bool outer) {
  std::vector<std::unique_ptr<ElementLines>> lines;
  for (const auto& [frame, set] : largest_first(brick_sets_[outer ? 1 : 0])) {
    lines.push_back(
        brick_lines(slots_, element_shapes_.axes(frame), brick_shapes_, form_rows(*set)));
  }
  for (const auto& [key, set] : largest_first(rectangle_sets_[outer ? 1 : 0])) {
    const auto& [frame, normal] = key;
    lines.push_back(shell_lines(slots_, element_shapes_.axes(frame), normal, rectangle_shapes_,
                                form_rows(*set)));
  }
  return lines;
}

BeamElements ElementSorter::beam_elements(bool outer, LocalIndex idle) const {
  std::vector<BeamElements::Beam> beams;
  for (const Element& element : beams_[outer ? 1 : 0]) {
    const auto slot = slots(element);
    beams.push_back(
        {{slot[0] < 0 ? idle : slot[0], slot[6] < 0 ? idle : slot[6]}, beam_numbers(element)});
  }
  return {beams, idle};
}

BatchElements<BeamShape> ElementSorter::batch_beams() const {
  std::vector<BatchElements<BeamShape>::Numbers> shapes;
  std::vector<BatchElements<BeamShape>::Element> elements;
  for (const Element& element : beams_.front()) {
    auto& entry = elements.emplace_back();
    entry.shape = shapes.size();
    std::ranges::copy_n(slots(element).begin(), entry.dofs.size(), entry.dofs.begin());
    shapes.push_back(beam_numbers(element));
  }
  return {shapes, std::move(elements)};
}

std::array<double, BeamShape::number_count> ElementSorter::beam_numbers(
    const Element& element) const {
  const auto [b, e] = element;
  return BeamShape::numbers(gather_coordinates(mesh_, mesh_.blocks[b], e, work_),
                            element_properties(structure_.regions[mesh_.blocks[b].region]));
}

std::vector<LocalIndex> ElementSorter::beam_dofs(bool outer) const {
  std::vector<LocalIndex> dofs;
  for (const Element& element : beams_[outer ? 1 : 0]) {
    for (const LocalIndex slot : slots(element)) {
      if (slot >= 0 && slot < mesh_.owned_dofs) dofs.push_back(slot);
    }
  }
  return dofs;
}

AssembledRows ElementSorter::assembled_rows() const {
  std::vector<Element> elements = others_;
  std::sort(elements.begin(), elements.end());  // sums in file order on any number of ranks
  AssembledRows::Pattern pattern(mesh_.owned_dofs);
  const auto size_of_element = [&](const Element& element) {
    return static_cast<std::size_t>(element_layout(mesh_.blocks[element.first].type).size());
  };
  for (const Element& element : elements) {
    pattern.add({slots(element).data(), size_of_element(element)});
  }
  AssembledRows rows(std::move(pattern));
  for (const Element& element : elements) {
    const auto [b, e] = element;
    const std::size_t size = size_of_element(element);
    const ElementBlock& block = mesh_.blocks[b];
    const std::span<double> stiffness(work_.stiffness.data(), size * size);
    element_shapes_.find_coordinates(b, e, work_);
    const std::size_t nodes = element_layout(block.type).nodes;
    const std::span<const double> coordinates(work_.coordinates.data(), 3 * nodes);
    element_matrices_in(structure_.numbers, block.type, coordinates,
                        element_properties(structure_.regions[block.region], block.share_of(e)),
                        stiffness, {work_.mass.data(), size});
    if (!block.axial_force.empty()) {
      add_geometric_stiffness(block.type, coordinates,
                              element_properties(structure_.regions[block.region]),
                              block.axial_force[e], stiffness);
    }
    rows.add({slots(element).data(), size}, stiffness);
  }
  return rows;
}

ElementKinds ElementSorter::kinds() const {
  const auto counted = [&](const std::vector<Element>& elements) {
    return std::count_if(elements.begin(), elements.end(), [&](const Element& element) {
      return mesh_.blocks[element.first].counted[element.second] != 0;
    });
  };
  ElementKinds kinds;
  for (const auto& sets : brick_sets_) {
    for (const auto& [frame, set] : sets) kinds.bricks += counted(set.elements);
  }
  for (const auto& sets : rectangle_sets_) {
    for (const auto& [key, set] : sets) kinds.rectangles += counted(set.elements);
  }
  kinds.general = general_.counted();
  kinds.single = general_.counted_single();
  kinds.skew = general_.counted_skew();
  for (const auto& beams : beams_) kinds.beams += counted(beams);
  kinds.other = counted(others_);
  return kinds;
}

bool ElementSorter::touches_ghost(const Element& element) const {
  const ElementBlock& block = mesh_.blocks[element.first];
  const std::size_t nodes = element_layout(block.type).nodes;
  const LocalIndex* const corner = &block.connectivity[element.second * nodes];
  return std::any_of(corner, corner + nodes,
                     [&](LocalIndex node) { return node >= mesh_.owned_nodes; });
}

ElementSorter::Slots ElementSorter::slots(const Element& element) const {
  const ElementBlock& block = mesh_.blocks[element.first];
  Slots slots{};
  std::ranges::transform(ElementDofs(mesh_, block, element.second), slots.begin(),
                         [&](LocalIndex dof) { return dof < 0 ? -1 : slots_.of_dof[dof]; });
  const Region& region = structure_.regions[block.region];
  for (std::size_t i = 0; region.of_water && i < slots.size(); ++i) {
    if (!is_spring(block.type) || region.mass_along[i % 3] == 0) slots[i] = -1;  // no stiffness
  }
  return slots;
}

}  // namespace pounding::stiffness
