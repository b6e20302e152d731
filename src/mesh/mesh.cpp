#include "mesh/mesh.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <unordered_map>

#include "common/parallel.h"
#include "elements/element.h"

namespace pounding {
namespace {

Mesh unpack(MPI_Comm comm, const std::string& name, MeshParcel&& parcel) {
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

/// Sends every rank the nodes that move together.
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

/// Sends every rank the nodes of absorbing faces; each keeps those that it owns.
void share_absorbing_nodes(MPI_Comm comm, std::vector<AbsorbingNode> nodes, Mesh& mesh) {
  broadcast_array(comm, nodes, 0);
  std::ranges::copy_if(
      nodes, std::back_inserter(mesh.absorbing),
      [&](const AbsorbingNode& absorbing) { return mesh.owned_node(absorbing.node) >= 0; });
}

/// Sends every rank the nodes on supports; each keeps those that it has, ghosts as well.
void share_supported_nodes(MPI_Comm comm, const NodeMarks& marks, Mesh& mesh) {
  mesh.ground_support = marks.ground_support;
  MPI_Bcast(&mesh.ground_support, 1, MPI_INT, 0, comm);
  std::vector<SupportedNode> nodes = marks.supported;
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

Mesh join_parcel(MPI_Comm comm, const std::string& name, MeshParcel&& parcel,
                 const NodeMarks& marks) {
  Mesh mesh = unpack(comm, name, std::move(parcel));
  share_rigid_parts(comm, marks.rigid, mesh);
  share_absorbing_nodes(comm, marks.absorbing, mesh);
  share_supported_nodes(comm, marks, mesh);
  return mesh;
}

Mesh distribute_mesh(MPI_Comm comm, const std::string& name, const GlobalMesh& global,
                     const Partition& partition, int structure) {
  MeshParcel mine;
  if (rank_of(comm) == 0) {
    const MeshCutter cutter(global, partition, structure);
    mine = cutter.parcel(0);
    for (int rank = 1; rank < size_of(comm); ++rank) {
      MeshParcel parcel = cutter.parcel(rank);
      parcel.for_each_array([&](const auto& array) { send_array(comm, rank, array); });
    }
  } else {
    mine.for_each_array([&](auto& array) { receive_array(comm, 0, array); });
  }
  return join_parcel(comm, name, std::move(mine), global);
}

}  // namespace pounding
