#include "mesh/mesh.h"

#include <numeric>
#include <stdexcept>
#include <unordered_map>

#include "common/parallel.h"
#include "elements/element_traits.h"

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
  mesh.blocks = std::move(parcel.blocks);
  return mesh;
}

/// The nodes of this rank that move together; parts of others keep their counts alone.
void take_rigid_parts(std::vector<RigidNodes>& rigid, Mesh& mesh) {
  mesh.rigid_of.assign(mesh.file_node.size(), -1);
  mesh.rigid_rows.assign(mesh.file_node.size(), 0);
  std::unordered_map<GlobalIndex, LocalIndex> local;
  for (LocalIndex n = 0; !rigid.empty() && n < mesh.node_count(); ++n) {
    local[mesh.file_node[n]] = n;
  }
  for (std::size_t i = 0; i < rigid.size(); ++i) {
    RigidPart& part = mesh.rigid.emplace_back();
    part.group = rigid[i].group;
    part.kind = rigid[i].kind;
    part.components = rigid[i].components;
    part.global_nodes = static_cast<GlobalIndex>(rigid[i].nodes.size());
    for (std::size_t k = 0; k < rigid[i].nodes.size(); ++k) {
      const auto found = local.find(rigid[i].nodes[k]);
      if (found == local.end()) continue;
      mesh.rigid_of[found->second] = static_cast<int>(i);
      mesh.rigid_rows[found->second] = rigid[i].rows.empty() ? part.components : rigid[i].rows[k];
      if (found->second < mesh.owned_nodes) part.nodes.push_back(found->second);
    }
    std::ranges::sort(part.nodes);
    if (part.nodes.empty()) continue;
    part.tied = std::move(rigid[i].tied);
    if (static_cast<GlobalIndex>(part.nodes.size()) != part.global_nodes) {
      throw std::logic_error("rigid group " + part.group + " lives on several ranks");
    }
  }
}

/// Sends every rank the marks of nodes; each keeps those of absorbing faces that it owns and those
/// on supports that it has, ghosts as well.
void share_marks(MPI_Comm comm, const NodeMarks& of_rank0, Mesh& mesh) {
  NodeMarks marks = rank_of(comm) == 0 ? of_rank0 : NodeMarks{};
  broadcast_values(comm, 0, marks);
  take_rigid_parts(marks.rigid, mesh);
  std::ranges::copy_if(
      marks.absorbing, std::back_inserter(mesh.absorbing),
      [&](const AbsorbingNode& absorbing) { return mesh.owned_node(absorbing.node) >= 0; });
  mesh.ground_support = marks.ground_support;
  mesh.water = std::move(marks.water);
  if (marks.supported.empty()) return;
  std::vector<GlobalIndex> local = mesh.file_node;
  std::ranges::sort(local);
  std::ranges::copy_if(
      marks.supported, std::back_inserter(mesh.supported),
      [&](const SupportedNode& node) { return std::ranges::binary_search(local, node.node); });
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
  return part >= 0 && std::all_of(nodes, nodes + width, [&](LocalIndex node) {
           return mesh.rigid_of[node] == part && mesh.rigid_rows[node] == 0x3f;
         });
}

Mesh join_parcel(MPI_Comm comm, const std::string& name, MeshParcel&& parcel,
                 const NodeMarks& marks) {
  Mesh mesh = unpack(comm, name, std::move(parcel));
  share_marks(comm, marks, mesh);
  return mesh;
}

Mesh distribute_mesh(MPI_Comm comm, const std::string& name, const GlobalMesh& global,
                     const Partition& partition, int structure) {
  MeshParcel mine;
  if (rank_of(comm) == 0) {
    const MeshCutter cutter(global, partition, structure);
    mine = cutter.parcel(0);
    for (int rank = 1; rank < size_of(comm); ++rank) {
      send_array(comm, rank, bytes_of(cutter.parcel(rank)));
    }
  } else {
    std::vector<char> bytes;
    receive_array(comm, 0, bytes);
    from_bytes(bytes, mine);
  }
  return join_parcel(comm, name, std::move(mine), global);
}

BoundingBox bounding_box(MPI_Comm comm, const Mesh& mesh) {
  BoundingBox box;
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) box.include(mesh.position(node));
  reduce_over_ranks(comm, MPI_MIN, box.low);
  reduce_over_ranks(comm, MPI_MAX, box.high);
  return box;
}

}  // namespace pounding
