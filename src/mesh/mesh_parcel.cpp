#include "mesh/mesh_parcel.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "common/integer_sets.h"
#include "elements/element_traits.h"
#include "mesh/element_groups.h"

namespace pounding {
namespace {

void require(bool fits) {
  if (!fits) throw std::runtime_error("parts of a mesh that do not belong together");
}

}  // namespace

void check_parcel(const MeshParcel& parcel, std::size_t regions) {
  const std::size_t nodes = parcel.file_node.size();
  const GlobalIndex owned = parcel.sizes[0];
  require(owned >= 0 && owned <= static_cast<GlobalIndex>(nodes));
  require(parcel.coordinates.size() == 3 * nodes && parcel.free_components.size() == nodes &&
          parcel.global_dof.size() == nodes);
  require(std::ranges::all_of(parcel.free_components, [](auto bits) { return bits <= 0x3f; }));
  for (const ElementBlock& block : parcel.blocks) {
    require(static_cast<int>(block.type) >= 0 && static_cast<int>(block.type) < element_type_count);
    require(block.region >= 0 && block.region < static_cast<int>(regions));
    const std::size_t width = element_layout(block.type).nodes;
    require(block.connectivity.size() == width * block.count() &&
            block.counted.size() == block.count() &&
            (block.share.empty() || block.share.size() == block.count()));
    require(std::ranges::all_of(block.connectivity, [&](LocalIndex node) {
      return node >= 0 && static_cast<std::size_t>(node) < nodes;
    }));
  }
}

MeshCutter::MeshCutter(const GlobalMesh& mesh, const Partition& partition, int structure)
    : mesh_(mesh), parts_(partition.parts), node_owner_(partition.node_owner[structure]) {
  sort_nodes();
  number_dofs();
  sort_elements();
}

MeshParcel MeshCutter::parcel(int part) const {
  MeshParcel out;
  const auto begin = node_begin_[part];
  const auto end = node_begin_[part + 1];
  const std::span<const Element> elements(elements_.data() + element_begin_[part],
                                          element_begin_[part + 1] - element_begin_[part]);
  const std::vector<GlobalIndex> ghosts = ghost_places(part, elements);
  add_elements(part, elements, ghosts, out);
  const std::size_t count = static_cast<std::size_t>(end - begin) + ghosts.size();
  out.file_node.reserve(count);
  out.free_components.reserve(count);
  out.global_dof.reserve(count);
  out.coordinates.reserve(3 * count);
  for (GlobalIndex place = begin; place < end; ++place) add_node(order_[place], out);
  for (const GlobalIndex place : ghosts) add_node(order_[place], out);
  out.sizes = {end - begin, mesh_.node_count(), dofs_, unclamped_dofs_, part_dof_[part]};
  return out;
}

/// Per rank, those without rotations first, in the order of the planes: where beams meet bricks,
/// the bricks' other nodes still follow each other.
void MeshCutter::sort_nodes() {
  const NodePlanes planes(mesh_);
  std::vector<std::tuple<int, bool, std::array<std::int64_t, 3>>> places;
  places.reserve(mesh_.node_tags.size());
  for (GlobalIndex node = 0; node < mesh_.node_count(); ++node) {
    const std::size_t n = node;
    places.emplace_back(node_owner_[n], mesh_.components[n] >> 3 != 0,
                        planes.place(mesh_.position(node)));
  }
  order_.resize(places.size());
  std::iota(order_.begin(), order_.end(), GlobalIndex{0});
  std::stable_sort(order_.begin(), order_.end(),
                   [&](GlobalIndex a, GlobalIndex b) { return places[a] < places[b]; });
  place_.resize(order_.size());
  for (std::size_t i = 0; i < order_.size(); ++i) place_[order_[i]] = static_cast<GlobalIndex>(i);
}

void MeshCutter::number_dofs() {
  node_begin_.assign(static_cast<std::size_t>(parts_) + 1, 0);
  part_dof_.assign(static_cast<std::size_t>(parts_) + 1, 0);
  first_dof_.resize(order_.size());
  for (const GlobalIndex node : order_) {
    const std::size_t n = node;
    const std::size_t part = node_owner_[n];
    first_dof_[n] = dofs_;
    dofs_ += component_count(mesh_.free_components[n]);
    unclamped_dofs_ += component_count(mesh_.components[n]);
    ++node_begin_[part + 1];
    part_dof_[part + 1] = dofs_;
  }
  for (std::size_t p = 1; p < node_begin_.size(); ++p) {
    node_begin_[p] += node_begin_[p - 1];
    part_dof_[p] = std::max(part_dof_[p], part_dof_[p - 1]);
  }
}

/// Calls `visit(part, element)` for every part that owns a node of an element, set after set.
template <typename Visit>
void MeshCutter::for_each_share(const Visit& visit) const {
  for (std::uint32_t s = 0; s < mesh_.regions.size(); ++s) {
    for (std::uint32_t e = 0; e < mesh_.regions[s].tags.size(); ++e) {
      const auto corners = mesh_.regions[s].nodes_of(e);
      for (std::size_t a = 0; a < corners.size(); ++a) {
        const auto same_part = [&](GlobalIndex node) {
          return node_owner_[node] == node_owner_[corners[a]];
        };
        if (std::ranges::none_of(corners.first(a), same_part)) {
          visit(static_cast<std::size_t>(node_owner_[corners[a]]), Element{s, e});
        }
      }
    }
  }
}

/// Elements of every part, in one pass however many parts there are.
void MeshCutter::sort_elements() {
  element_begin_.assign(static_cast<std::size_t>(parts_) + 1, 0);
  for_each_share([&](std::size_t part, Element) { ++element_begin_[part + 1]; });
  std::partial_sum(element_begin_.begin(), element_begin_.end(), element_begin_.begin());
  elements_.resize(element_begin_.back());
  std::vector<std::size_t> next(element_begin_.begin(), element_begin_.end() - 1);
  for_each_share(
      [&](std::size_t part, const Element& element) { elements_[next[part]++] = element; });
}

/// The other nodes of the elements, in the order in which their owners hold them, as places in
/// order_.
std::vector<GlobalIndex> MeshCutter::ghost_places(int part,
                                                  std::span<const Element> elements) const {
  std::vector<GlobalIndex> ghosts;
  for (const Element& element : elements) {
    for (const GlobalIndex node : nodes_of(element)) {
      if (node_owner_[node] != part) ghosts.push_back(place_[node]);
    }
  }
  keep_once(ghosts);
  return ghosts;
}

void MeshCutter::add_node(GlobalIndex node, MeshParcel& out) const {
  out.file_node.push_back(node);
  out.free_components.push_back(mesh_.free_components[node]);
  out.global_dof.push_back(first_dof_[node]);
  const Vector3 x = mesh_.position(node);
  out.coordinates.insert(out.coordinates.end(), x.begin(), x.end());
}

/// Number of a node on the rank of a part.
LocalIndex MeshCutter::local(GlobalIndex node, int part,
                             const std::vector<GlobalIndex>& ghosts) const {
  const GlobalIndex begin = node_begin_[part];
  const GlobalIndex place = place_[node];
  if (node_owner_[node] == part) return static_cast<LocalIndex>(place - begin);
  const auto found = std::ranges::lower_bound(ghosts, place);
  return static_cast<LocalIndex>(node_begin_[part + 1] - begin + (found - ghosts.begin()));
}

void MeshCutter::add_elements(int part, std::span<const Element> elements,
                              const std::vector<GlobalIndex>& ghosts, MeshParcel& out) const {
  std::vector<std::size_t> here(mesh_.regions.size(), 0);
  for (const Element& element : elements) ++here[element.set];
  for (const ElementSet& set : mesh_.regions) {
    ElementBlock& block = out.blocks.emplace_back();
    block.group = set.group;
    block.region = set.region;
    block.type = set.type;
    block.global_count = static_cast<GlobalIndex>(set.tags.size());
    const std::size_t count = here[out.blocks.size() - 1];
    block.tags.reserve(count);
    block.counted.reserve(count);
    block.connectivity.reserve(count * element_layout(set.type).nodes);
    if (!set.share.empty()) block.share.reserve(count);
  }
  for (const Element& element : elements) {
    const auto corners = nodes_of(element);
    const ElementSet& set = mesh_.regions[element.set];
    ElementBlock& block = out.blocks[element.set];
    block.tags.push_back(set.tags[element.number]);
    if (!set.share.empty()) block.share.push_back(set.share[element.number]);
    // Counted where its first node is owned: that rank surely holds the element.
    block.counted.push_back(node_owner_[corners[0]] == part ? 1 : 0);
    for (const GlobalIndex node : corners) block.connectivity.push_back(local(node, part, ghosts));
  }
}

}  // namespace pounding
