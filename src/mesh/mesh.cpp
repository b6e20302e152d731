#include "mesh/mesh.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <unordered_map>

#include "common/parallel.h"
#include "elements/element.h"
#include "mesh/node_planes.h"

namespace pounding {
namespace {

/// Arrays of a mesh that travel to one rank.
struct Parcel {
  std::vector<GlobalIndex>
      sizes;  ///< owned nodes, global nodes, dofs, unclamped dofs, first dof, regions
  std::vector<GlobalIndex> file_node;
  std::vector<double> coordinates;
  std::vector<std::uint8_t> free_components;
  std::vector<GlobalIndex> global_dof;
  std::vector<GlobalIndex> region;  ///< per set: type, region, global count, elements here,
                                    ///< whether these have a share
  std::vector<double> share;        ///< of the elements of sets that have one
  std::vector<char> names;          ///< of the regions, zero-terminated
  std::vector<std::int64_t> tags;
  std::vector<LocalIndex> connectivity;
  std::vector<std::uint8_t> counted;

  template <typename Function>
  void for_each_array(Function&& function) {
    function(sizes);
    function(file_node);
    function(coordinates);
    function(free_components);
    function(global_dof);
    function(region);
    function(share);
    function(names);
    function(tags);
    function(connectivity);
    function(counted);
  }
};

/// Numbers nodes and dofs rank by rank and cuts the parcels; lives on rank 0.
class Cutter {
 public:
  Cutter(const GlobalMesh& mesh, const Partition& partition, int structure)
      : mesh_(mesh), parts_(partition.parts), node_owner_(partition.node_owner[structure]) {
    sort_nodes();
    number_dofs();
    sort_elements();
  }

  Parcel parcel(int part) const {
    Parcel out;
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
    out.sizes = {end - begin,     mesh_.node_count(),
                 dofs_,           unclamped_dofs_,
                 part_dof_[part], static_cast<GlobalIndex>(mesh_.regions.size())};
    return out;
  }

 private:
  struct Element {
    std::uint32_t set = 0;
    std::uint32_t number = 0;  ///< in the set
  };

  /// Per rank, those without rotations first, in the order of the planes: where beams meet bricks,
  /// the bricks' other nodes still follow each other.
  void sort_nodes() {
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

  void number_dofs() {
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

  std::span<const GlobalIndex> corners_of(const Element& element) const {
    const ElementSet& set = mesh_.regions[element.set];
    const std::size_t width = element_layout(set.type).nodes;
    return {&set.connectivity[element.number * width], width};
  }

  /// Calls `visit(part, element)` for every part that owns a node of an element, set after set.
  template <typename Visit>
  void for_each_share(const Visit& visit) const {
    for (std::uint32_t s = 0; s < mesh_.regions.size(); ++s) {
      for (std::uint32_t e = 0; e < mesh_.regions[s].tags.size(); ++e) {
        const auto corners = corners_of({s, e});
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
  void sort_elements() {
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
  std::vector<GlobalIndex> ghost_places(int part, std::span<const Element> elements) const {
    std::vector<GlobalIndex> ghosts;
    for (const Element& element : elements) {
      for (const GlobalIndex node : corners_of(element)) {
        if (node_owner_[node] != part) ghosts.push_back(place_[node]);
      }
    }
    std::ranges::sort(ghosts);
    const auto rest = std::ranges::unique(ghosts);
    ghosts.erase(rest.begin(), rest.end());
    return ghosts;
  }

  void add_node(GlobalIndex node, Parcel& out) const {
    out.file_node.push_back(node);
    out.free_components.push_back(mesh_.free_components[node]);
    out.global_dof.push_back(first_dof_[node]);
    const Vector3 x = mesh_.position(node);
    out.coordinates.insert(out.coordinates.end(), x.begin(), x.end());
  }

  /// Number of a node on the rank of a part.
  LocalIndex local(GlobalIndex node, int part, const std::vector<GlobalIndex>& ghosts) const {
    const GlobalIndex begin = node_begin_[part];
    const GlobalIndex place = place_[node];
    if (node_owner_[node] == part) return static_cast<LocalIndex>(place - begin);
    const auto found = std::ranges::lower_bound(ghosts, place);
    return static_cast<LocalIndex>(node_begin_[part + 1] - begin + (found - ghosts.begin()));
  }

  void add_elements(int part, std::span<const Element> elements,
                    const std::vector<GlobalIndex>& ghosts, Parcel& out) const {
    std::vector<GlobalIndex> here(mesh_.regions.size(), 0);
    std::size_t corner_count = 0;
    for (const Element& element : elements) corner_count += corners_of(element).size();
    out.tags.reserve(elements.size());
    out.counted.reserve(elements.size());
    out.connectivity.reserve(corner_count);
    for (const Element& element : elements) {
      const auto corners = corners_of(element);
      ++here[element.set];
      const ElementSet& set = mesh_.regions[element.set];
      out.tags.push_back(set.tags[element.number]);
      if (!set.share.empty()) out.share.push_back(set.share[element.number]);
      // Counted where its first node is owned: that rank surely holds the element.
      out.counted.push_back(node_owner_[corners[0]] == part ? 1 : 0);
      for (const GlobalIndex node : corners) out.connectivity.push_back(local(node, part, ghosts));
    }
    for (std::size_t s = 0; s < mesh_.regions.size(); ++s) {
      const ElementSet& set = mesh_.regions[s];
      out.region.insert(out.region.end(), {static_cast<GlobalIndex>(set.type), set.region,
                                           static_cast<GlobalIndex>(set.tags.size()), here[s],
                                           static_cast<GlobalIndex>(set.share.empty() ? 0 : 1)});
      out.names.insert(out.names.end(), set.group.begin(), set.group.end());
      out.names.push_back('\0');
    }
  }

  const GlobalMesh& mesh_;
  int parts_;
  const std::vector<int>& node_owner_;
  std::vector<GlobalIndex> order_;          ///< nodes by rank, see sort_nodes
  std::vector<GlobalIndex> place_;          ///< of each node in order_
  std::vector<GlobalIndex> node_begin_;     ///< per rank, into order_
  std::vector<GlobalIndex> part_dof_;       ///< per rank, first dof
  std::vector<GlobalIndex> first_dof_;      ///< per node in file order
  std::vector<std::size_t> element_begin_;  ///< per rank, into elements_
  std::vector<Element> elements_;           ///< that touch a node of a rank, rank by rank
  GlobalIndex dofs_ = 0;
  GlobalIndex unclamped_dofs_ = 0;
};

Mesh unpack(MPI_Comm comm, const std::string& name, Parcel&& parcel) {
  Mesh mesh;
  mesh.comm = comm;
  mesh.structure = name;
  mesh.owned_nodes = static_cast<LocalIndex>(parcel.sizes[0]);
  mesh.global_nodes = parcel.sizes[1];
  mesh.global_dofs = parcel.sizes[2];
  mesh.global_dofs_unclamped = parcel.sizes[3];
  mesh.first_owned_dof = parcel.sizes[4];
  mesh.file_node = std::move(parcel.file_node);
  mesh.coordinates = std::move(parcel.coordinates);
  mesh.free_components = std::move(parcel.free_components);
  mesh.ghost_dof.assign(parcel.global_dof.begin() + mesh.owned_nodes, parcel.global_dof.end());
  mesh.first_dof.resize(mesh.file_node.size());
  for (LocalIndex node = 0; node < mesh.node_count(); ++node) {
    const std::size_t n = node;
    mesh.first_dof[n] = mesh.dof_count;
    mesh.dof_count += component_count(mesh.free_components[n]);
    if (node < mesh.owned_nodes) mesh.owned_dofs = mesh.dof_count;
  }
  mesh.by_file_node.resize(mesh.owned_nodes);
  std::iota(mesh.by_file_node.begin(), mesh.by_file_node.end(), LocalIndex{0});
  std::sort(mesh.by_file_node.begin(), mesh.by_file_node.end(),
            [&](LocalIndex a, LocalIndex b) { return mesh.file_node[a] < mesh.file_node[b]; });
  std::size_t element = 0;
  std::size_t corner = 0;
  std::size_t shared = 0;
  const char* text = parcel.names.data();
  for (std::size_t r = 0; r < parcel.region.size(); r += 5) {
    ElementBlock block;
    block.group = text;
    text += block.group.size() + 1;
    block.type = static_cast<ElementType>(parcel.region[r]);
    block.region = static_cast<int>(parcel.region[r + 1]);
    block.global_count = parcel.region[r + 2];
    const std::size_t count = parcel.region[r + 3];
    const std::size_t corners = count * static_cast<std::size_t>(element_layout(block.type).nodes);
    const auto from = [](const auto& values, std::size_t begin, std::size_t length) {
      return std::vector(values.begin() + static_cast<std::ptrdiff_t>(begin),
                         values.begin() + static_cast<std::ptrdiff_t>(begin + length));
    };
    block.tags = from(parcel.tags, element, count);
    block.counted = from(parcel.counted, element, count);
    block.connectivity = from(parcel.connectivity, corner, corners);
    if (parcel.region[r + 4] != 0) {
      block.share = from(parcel.share, shared, count);
      shared += count;
    }
    element += count;
    corner += corners;
    mesh.blocks.push_back(std::move(block));
  }
  return mesh;
}

/// Groups that move together, all in a few arrays.
struct RigidParcel {
  std::vector<char> names;          ///< zero-terminated
  std::vector<std::uint8_t> kinds;  ///< kind and components of each
  std::vector<GlobalIndex> counts;  ///< nodes of each
  std::vector<GlobalIndex> nodes;
  std::vector<GlobalIndex> ties;      ///< of each: tied nodes; of these: node, group, carriers
  std::vector<GlobalIndex> carriers;  ///< their nodes
  std::vector<double> blocks;         ///< theirs

  explicit RigidParcel(const std::vector<RigidNodes>& rigid) {
    for (const RigidNodes& part : rigid) {
      names.insert(names.end(), part.group.begin(), part.group.end());
      names.push_back('\0');
      kinds.push_back(static_cast<std::uint8_t>(part.kind));
      kinds.push_back(part.components);
      counts.push_back(static_cast<GlobalIndex>(part.nodes.size()));
      nodes.insert(nodes.end(), part.nodes.begin(), part.nodes.end());
      ties.push_back(static_cast<GlobalIndex>(part.tied.size()));
      for (const TiedNode& tied : part.tied) add(tied);
    }
  }

  void add(const TiedNode& tied) {
    ties.insert(ties.end(),
                {tied.node, tied.group, static_cast<GlobalIndex>(tied.carriers.size())});
    for (const Carrier& carrier : tied.carriers) {
      carriers.push_back(carrier.node);
      blocks.insert(blocks.end(), carrier.block.begin(), carrier.block.end());
    }
  }

  template <typename Function>
  void for_each_array(Function&& function) {
    function(names);
    function(kinds);
    function(counts);
    function(nodes);
    function(ties);
    function(carriers);
    function(blocks);
  }
};

/// Reads the tied nodes of one part after the other.
class TiedReader {
 public:
  explicit TiedReader(const RigidParcel& parcel)
      : parcel_(parcel), place_(parcel.ties.begin()), first_(0) {}

  std::vector<TiedNode> next() {
    std::vector<TiedNode> found(static_cast<std::size_t>(*place_++));
    for (TiedNode& tied : found) {
      tied.node = *place_++;
      tied.group = static_cast<int>(*place_++);
      tied.carriers.resize(static_cast<std::size_t>(*place_++));
      for (Carrier& carrier : tied.carriers) {
        carrier.node = parcel_.carriers[first_];
        std::copy_n(&parcel_.blocks[carrier.block.size() * first_++], carrier.block.size(),
                    carrier.block.begin());
      }
    }
    return found;
  }

 private:
  const RigidParcel& parcel_;
  std::vector<GlobalIndex>::const_iterator place_;
  std::size_t first_;  ///< carrier that is next
};

/// Tells every rank what moves together.
void share_rigid_parts(MPI_Comm comm, const std::vector<RigidNodes>& rigid, Mesh& mesh) {
  RigidParcel parcel(rigid);
  parcel.for_each_array([&](auto& array) { broadcast_array(comm, array, 0); });
  mesh.rigid_of.assign(mesh.file_node.size(), -1);
  std::unordered_map<GlobalIndex, LocalIndex> local;
  for (LocalIndex n = 0; !parcel.counts.empty() && n < mesh.node_count(); ++n) {
    local[mesh.file_node[n]] = n;
  }
  const char* name = parcel.names.data();
  auto node = parcel.nodes.begin();
  TiedReader ties(parcel);
  for (std::size_t i = 0; i < parcel.counts.size(); ++i) {
    RigidPart& part = mesh.rigid.emplace_back();
    part.group = name;
    name += part.group.size() + 1;
    part.kind = static_cast<RigidKind>(parcel.kinds[2 * i]);
    part.components = parcel.kinds[2 * i + 1];
    part.global_nodes = parcel.counts[i];
    for (const auto end = node + parcel.counts[i]; node != end; ++node) {
      const auto found = local.find(*node);
      if (found == local.end()) continue;
      mesh.rigid_of[found->second] = static_cast<int>(i);
      if (found->second < mesh.owned_nodes) part.nodes.push_back(found->second);
    }
    std::ranges::sort(part.nodes);
    part.tied = ties.next();
    if (part.nodes.empty()) part.tied.clear();
    if (!part.nodes.empty() && static_cast<GlobalIndex>(part.nodes.size()) != part.global_nodes) {
      throw std::logic_error("rigid group " + part.group + " lives on several ranks");
    }
  }
}

/// Tells every rank the nodes of absorbing faces; each keeps those that it owns.
void share_absorbing_nodes(MPI_Comm comm, std::vector<AbsorbingNode> nodes, Mesh& mesh) {
  broadcast_array(comm, nodes, 0);
  std::ranges::copy_if(
      nodes, std::back_inserter(mesh.absorbing),
      [&](const AbsorbingNode& absorbing) { return mesh.owned_node(absorbing.node) >= 0; });
}

/// Tells every rank the nodes on supports; each keeps those that it has, ghosts as well.
void share_supported_nodes(MPI_Comm comm, const GlobalMesh& global, Mesh& mesh) {
  mesh.ground_support = global.ground_support;
  MPI_Bcast(&mesh.ground_support, 1, MPI_INT, 0, comm);
  std::vector<SupportedNode> nodes = global.supported;
  broadcast_array(comm, nodes, 0);
  if (nodes.empty()) return;
  std::vector<GlobalIndex> local = mesh.file_node;
  std::ranges::sort(local);
  std::ranges::copy_if(nodes, std::back_inserter(mesh.supported), [&](const SupportedNode& node) {
    return std::ranges::binary_search(local, node.node);
  });
}

}  // namespace

bool meets_rigid_body(const Mesh& mesh, const ElementBlock& block, std::size_t element) {
  const std::size_t width = element_layout(block.type).nodes;
  const LocalIndex* const nodes = &block.connectivity[element * width];
  return !mesh.rigid.empty() && std::any_of(nodes, nodes + width, [&](LocalIndex node) {
    return mesh.rigid_of[node] >= 0;
  });
}

bool is_in_rigid_body(const Mesh& mesh, const ElementBlock& block, std::size_t element) {
  const std::size_t width = element_layout(block.type).nodes;
  const LocalIndex* const nodes = &block.connectivity[element * width];
  if (mesh.rigid.empty() || width < 2) return false;
  const int part = mesh.rigid_of[nodes[0]];
  return part >= 0 && mesh.rigid[part].is_whole() &&
         std::all_of(nodes, nodes + width,
                     [&](LocalIndex node) { return mesh.rigid_of[node] == part; });
}

Mesh distribute_mesh(MPI_Comm comm, const std::string& name, const GlobalMesh& global,
                     const Partition& partition, int structure) {
  Parcel mine;
  if (rank_of(comm) == 0) {
    const Cutter cutter(global, partition, structure);
    mine = cutter.parcel(0);
    for (int rank = 1; rank < size_of(comm); ++rank) {
      Parcel parcel = cutter.parcel(rank);
      parcel.for_each_array([&](const auto& array) { send_array(comm, rank, array); });
    }
  } else {
    mine.for_each_array([&](auto& array) { receive_array(comm, 0, array); });
  }
  Mesh mesh = unpack(comm, name, std::move(mine));
  share_rigid_parts(comm, global.rigid, mesh);
  share_absorbing_nodes(comm, global.absorbing, mesh);
  share_supported_nodes(comm, global, mesh);
  return mesh;
}

}  // namespace pounding
