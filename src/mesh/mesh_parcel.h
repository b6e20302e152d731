#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesh/global_mesh.h"
#include "mesh/partition.h"

namespace pounding {

/// Elements of one kind and region on this rank: every element that touches an owned node, so that
/// this rank can build all that its owned dofs need without asking others. Sorted as in the file.
struct ElementBlock {
  std::string group;
  int region = 0;  ///< index into the structure's regions
  ElementType type = ElementType::hex8;
  std::vector<std::int64_t> tags;        ///< as in the file
  std::vector<LocalIndex> connectivity;  ///< shape (n_elements, nodes of the type), local nodes
  std::vector<std::uint8_t> counted;     ///< 1 on the one rank that counts the element
  GlobalIndex global_count = 0;          ///< elements of the region over all ranks
  std::vector<double> share;             ///< of each element, see ElementSet
  /// Axial force at rest of each beam or bar, tension above 0 [N]; empty without P-Delta.
  std::vector<double> axial_force;
  std::size_t count() const { return tags.size(); }
  double share_of(std::size_t element) const { return share.empty() ? 1 : share[element]; }

  static void members(auto& self, auto& stream) {
    stream(self.group, self.region, self.type, self.tags, self.connectivity, self.counted,
           self.global_count, self.share);
  }
};

/// One rank's part of a structure's mesh, as it travels.
struct MeshParcel {
  /// Owned nodes, global nodes, dofs, unclamped dofs, first dof.
  std::array<GlobalIndex, 5> sizes{};
  std::vector<GlobalIndex> file_node;
  std::vector<double> coordinates;
  std::vector<std::uint8_t> free_components;
  std::vector<GlobalIndex> global_dof;
  std::vector<ElementBlock> blocks;

  static void members(auto& self, auto& stream) {
    stream(self.sizes, self.file_node, self.coordinates, self.free_components, self.global_dof,
           self.blocks);
  }
};

/// Throws std::runtime_error where sizes or numbers in a parcel do not belong together, or to a
/// structure of `regions` regions.
void check_parcel(const MeshParcel& parcel, std::size_t regions);

/// Numbers nodes and dofs of a structure rank by rank and cuts its mesh into parcels. Serial; mesh
/// and partition must outlive it.
class MeshCutter {
 public:
  MeshCutter(const GlobalMesh& mesh, const Partition& partition, int structure);

  /// Part of one rank: every element that touches a node which the rank owns.
  MeshParcel parcel(int part) const;

 private:
  struct Element {
    std::uint32_t set = 0;
    std::uint32_t number = 0;  ///< in the set
  };

  void sort_nodes();
  void number_dofs();
  void sort_elements();
  std::span<const GlobalIndex> nodes_of(const Element& element) const {
    return mesh_.regions[element.set].nodes_of(element.number);
  }
  template <typename Visit>
  void for_each_share(const Visit& visit) const;
  std::vector<GlobalIndex> ghost_places(int part, std::span<const Element> elements) const;
  void add_node(GlobalIndex node, MeshParcel& out) const;
  LocalIndex local(GlobalIndex node, int part, const std::vector<GlobalIndex>& ghosts) const;
  void add_elements(int part, std::span<const Element> elements,
                    const std::vector<GlobalIndex>& ghosts, MeshParcel& out) const;

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

}  // namespace pounding
