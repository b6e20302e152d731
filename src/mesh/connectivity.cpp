#include "mesh/connectivity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <span>

#include "common/integer_sets.h"
#include "common/matrix3.h"
#include "elements/element_traits.h"
#include "mesh/facet_point.h"

namespace pounding {
namespace {

/// Elements that meet at a node, counted by kind.
struct Meeting {
  int lines = 0;
  int beams = 0;
  int shells = 0;
  int solids = 0;
};

/// Counts the independent rigid motions that some components of nodes see: how many of a piece's
/// motions its supports prevent.
class RigidRank {
 public:
  /// `origin` and `size` > 0 [m] of the piece make lengths and angles comparable.
  RigidRank(const Vector3& origin, double size) : origin_(origin), size_(size) {}

  /// Adds component 0-5 of a node (translations, rotations).
  void add(const Vector3& node, int component) {
    constexpr double independent = 1e-6;  // of a row of about unit length
    if (basis_.size() == 6) return;
    Vector3 arm = node;
    for (std::size_t d = 0; d < 3; ++d) arm[d] = (arm[d] - origin_[d]) / size_;
    std::array<double, 6> row = rigid_motion_row(static_cast<std::size_t>(component), arm);
    for (int turn = 0; turn < 2; ++turn) {
      for (const std::array<double, 6>& known : basis_) {
        const double share = std::inner_product(row.begin(), row.end(), known.begin(), 0.0);
        for (std::size_t i = 0; i < 6; ++i) row[i] -= share * known[i];
      }
    }
    const double length = std::sqrt(std::inner_product(row.begin(), row.end(), row.begin(), 0.0));
    if (length > independent) {
      for (double& value : row) value /= length;
      basis_.push_back(row);
    }
  }
  int rank() const { return static_cast<int>(basis_.size()); }

 private:
  Vector3 origin_;
  double size_;
  std::vector<std::array<double, 6>> basis_;  ///< orthonormal
};

class Examination {
 public:
  Examination(const Structure& structure, const GlobalMesh& mesh)
      : structure_(structure), mesh_(mesh), meeting_(size_of_mesh()), pieces_(size_of_mesh()) {}

  Connectivity run() {
    for (const ElementSet& set : mesh_.regions) {
      for (std::size_t e = 0; e < set.tags.size(); ++e) join(set, set.nodes_of(e));
    }
    join_rigid_bodies();
    find_pieces();
    find_coincident();
    find_ends_inside();
    find_hinges();
    return std::move(found_);
  }

 private:
  std::size_t size_of_mesh() const { return mesh_.node_tags.size(); }

  std::size_t piece_of(GlobalIndex node) { return pieces_.root(static_cast<std::size_t>(node)); }

  void join(const ElementSet& set, std::span<const GlobalIndex> nodes) {
    for (const GlobalIndex node : nodes) {
      pieces_.join(static_cast<std::size_t>(node), static_cast<std::size_t>(nodes.front()));
      Meeting& meeting = meeting_[node];
      meeting.lines += joins_two_nodes(set.type) ? 1 : 0;
      meeting.beams += is_beam(set.type) ? 1 : 0;
      meeting.shells += is_shell(set.type) ? 1 : 0;
      meeting.solids += is_solid(set.type) ? 1 : 0;
    }
  }

  void join_rigid_bodies() {
    rigid_of_.assign(mesh_.rigid.empty() ? 0 : size_of_mesh(), -1);
    for (std::size_t r = 0; r < mesh_.rigid.size(); ++r) {
      const std::vector<GlobalIndex>& nodes = mesh_.rigid[r].nodes;
      for (const GlobalIndex node : nodes) {
        pieces_.join(static_cast<std::size_t>(node), static_cast<std::size_t>(nodes.front()));
        rigid_of_[node] = static_cast<int>(r);
      }
      for (const TiedNode& tied : mesh_.rigid[r].tied) {
        for (const Carrier& carrier : tied.carriers) {  // clamped ones as well
          pieces_.join(static_cast<std::size_t>(tied.node), static_cast<std::size_t>(carrier.node));
          rigid_of_[carrier.node] = static_cast<int>(r);
        }
      }
    }
  }

  bool in_one_body(GlobalIndex a, GlobalIndex b) const {
    return !rigid_of_.empty() && rigid_of_[a] >= 0 && rigid_of_[a] == rigid_of_[b];
  }

  void find_pieces() {
    const double size = std::max(bounding_box({&mesh_, 1}).diagonal(), 1e-300);
    std::vector<std::ptrdiff_t> number(size_of_mesh(), -1);
    std::vector<RigidRank> possible;
    std::vector<RigidRank> prevented;
    for (GlobalIndex node = 0; node < mesh_.node_count(); ++node) {
      const std::size_t root = piece_of(node);
      if (number[root] < 0) {
        number[root] = static_cast<std::ptrdiff_t>(found_.pieces.size());
        found_.pieces.push_back({0, false, mesh_.position(node)});
        possible.emplace_back(mesh_.position(node), size);
        prevented.emplace_back(mesh_.position(node), size);
      }
      const std::size_t piece = number[root];
      ++found_.pieces[piece].nodes;
      add_components(node, mesh_.components[node], possible[piece]);
      add_components(node, mesh_.clamped(node), prevented[piece]);
    }
    for (const ElementSet& set : mesh_.regions) {
      for (std::size_t i = 0; is_grounded(set.type) && i < set.connectivity.size(); ++i) {
        const GlobalIndex node = set.connectivity[i];
        add_components(node, stiff_components(set), prevented[number[piece_of(node)]]);
      }
    }
    for (std::size_t p = 0; p < found_.pieces.size(); ++p) {
      found_.pieces[p].rigid_motions = possible[p].rank();
      found_.pieces[p].held_motions = prevented[p].rank();
      found_.pieces[p].held = prevented[p].rank() > 0;
    }
    for (const AbsorbingNode& absorbing : mesh_.absorbing) {
      found_.pieces[number[piece_of(absorbing.node)]].held = true;
    }
    std::ranges::stable_sort(found_.pieces, std::ranges::greater{}, &Piece::nodes);
  }

  void add_components(GlobalIndex node, std::uint8_t mask, RigidRank& motions) const {
    for (int c = 0; c < 6; ++c) {
      if ((mask >> c & 1) != 0) motions.add(mesh_.position(node), c);
    }
  }

  /// Components that a grounded spring or its dashpot resists.
  std::uint8_t stiff_components(const ElementSet& set) const {
    const Region& region = structure_.regions[set.region];
    unsigned mask = 0;
    for (std::size_t c = 0; c < 6; ++c) {
      mask |= region.stiffness[c] > 0 || region.dashpot[c] > 0 ? 1U << c : 0U;
    }
    return static_cast<std::uint8_t>(mask);
  }

  void find_coincident() {
    const double near = coincidence * bounding_box({&mesh_, 1}).diagonal();
    if (!(near > 0)) return;
    auto pairs = near_nodes(mesh_, near);
    std::erase_if(pairs, [this](const auto& pair) {
      return in_one_body(pair.first, pair.second) ||
             (mesh_.free_components[pair.first] == 0 && mesh_.free_components[pair.second] == 0);
    });
    std::set<std::pair<GlobalIndex, GlobalIndex>> joined;
    for (const ElementSet& set : mesh_.regions) {
      for (std::size_t e = 0; !pairs.empty() && joins_two_nodes(set.type) && e < set.tags.size();
           ++e) {
        const auto nodes = set.nodes_of(e);
        joined.insert(std::minmax(nodes[0], nodes[1]));
      }
    }
    for (const auto& pair : pairs) {
      if (!joined.contains(pair)) {
        const bool apart = piece_of(pair.first) != piece_of(pair.second);
        (apart ? found_.coincident_apart : found_.coincident_inside)
            .add(mesh_.position(pair.first));
      }
    }
  }

  /// Ends of lines at which nothing else is and nothing holds, by increasing x.
  std::vector<GlobalIndex> free_ends() const {
    std::vector<GlobalIndex> ends;
    for (GlobalIndex node = 0; node < mesh_.node_count(); ++node) {
      const Meeting& meeting = meeting_[node];
      if (meeting.lines == 1 && meeting.shells == 0 && meeting.solids == 0 &&
          mesh_.clamped(node) == 0) {
        ends.push_back(node);
      }
    }
    std::ranges::sort(ends, {}, [this](GlobalIndex node) { return mesh_.position(node)[0]; });
    return ends;
  }

  void find_ends_inside() {
    const std::vector<GlobalIndex> ends = free_ends();
    std::set<GlobalIndex> inside;
    for (const ElementSet& set : mesh_.regions) {
      const bool solid = carries_faces(set.type) || joins_two_nodes(set.type);
      for (std::size_t e = 0; solid && !ends.empty() && e < set.tags.size(); ++e) {
        find_ends_in(set, set.nodes_of(e), ends, inside);
      }
    }
    for (const GlobalIndex node : inside) found_.ends_inside.add(mesh_.position(node));
  }

  void find_ends_in(const ElementSet& set, std::span<const GlobalIndex> nodes,
                    const std::vector<GlobalIndex>& ends, std::set<GlobalIndex>& inside) const {
    constexpr double tolerance = 1e-4;  // of the element
    std::array<Vector3, max_element_nodes> corners;
    for (std::size_t a = 0; a < nodes.size(); ++a) corners[a] = mesh_.position(nodes[a]);
    const BoundingBox box = bounding_box(mesh_, nodes);
    const double thickness = is_shell(set.type) ? structure_.regions[set.region].thickness : 0;
    const double reach = tolerance * box.diagonal() + thickness / 2;
    const auto x_of = [this](GlobalIndex node) { return mesh_.position(node)[0]; };
    const auto first = std::ranges::lower_bound(ends, box.low[0] - reach, {}, x_of);
    for (auto end = first; end != ends.end() && x_of(*end) <= box.high[0] + reach; ++end) {
      const bool joined = std::ranges::any_of(
          nodes, [&](GlobalIndex node) { return node == *end || in_one_body(node, *end); });
      if (!joined &&
          is_in_element(set.type, {corners.data(), nodes.size()}, mesh_.position(*end), reach) &&
          !shares_line(*end, nodes)) {
        inside.insert(*end);
      }
    }
  }

  /// Whether the other end of a free end's line is a node of an element: a line may leave it along
  /// one of its faces.
  bool shares_line(GlobalIndex end, std::span<const GlobalIndex> nodes) const {
    for (const ElementSet& set : mesh_.regions) {
      for (std::size_t e = 0; joins_two_nodes(set.type) && e < set.tags.size(); ++e) {
        const auto line = set.nodes_of(e);
        if (line[0] == end || line[1] == end) {
          const GlobalIndex other = line[0] == end ? line[1] : line[0];
          return std::ranges::find(nodes, other) != nodes.end();
        }
      }
    }
    return false;
  }

  void find_hinges() {
    for (GlobalIndex node = 0; node < mesh_.node_count(); ++node) {
      const Meeting& meeting = meeting_[node];
      const bool turns = (mesh_.free_components[node] & rotation_bits) == rotation_bits;
      if (meeting.solids > 0 && meeting.beams + meeting.shells > 0 && turns) {
        found_.hinges.add(mesh_.position(node));
        if (meeting.beams == 1 && meeting.shells == 0) found_.lone_hinges.add(mesh_.position(node));
      }
    }
  }

  const Structure& structure_;
  const GlobalMesh& mesh_;
  std::vector<Meeting> meeting_;
  DisjointSets pieces_;        ///< of the nodes
  std::vector<int> rigid_of_;  ///< per node its rigid body, -1: none; empty without any
  Connectivity found_;
};

using GridCell = std::array<std::int64_t, 3>;

struct NodeInCell {
  GridCell cell;
  GlobalIndex node;
  auto operator<=>(const NodeInCell&) const = default;
};

/// The cells that a node's surroundings reach into: mostly one.
void add_cells(const Vector3& x, double side, double distance, GlobalIndex node,
               std::vector<NodeInCell>& entries) {
  // Meshes like round numbers: their planes are kept off the borders of cells.
  constexpr double offset = 0.3819660112501051;
  GridCell low{};
  GridCell high{};
  for (std::size_t d = 0; d < 3; ++d) {
    low[d] = static_cast<std::int64_t>(std::floor((x[d] - distance) / side + offset));
    high[d] = static_cast<std::int64_t>(std::floor((x[d] + distance) / side + offset));
  }
  for (std::int64_t i = low[0]; i <= high[0]; ++i) {
    for (std::int64_t j = low[1]; j <= high[1]; ++j) {
      for (std::int64_t k = low[2]; k <= high[2]; ++k) entries.push_back({{i, j, k}, node});
    }
  }
}

}  // namespace

GlobalIndex Connectivity::loose_pieces() const {
  return std::ranges::count(pieces, false, &Piece::held);
}

bool Connectivity::wholly_held() const {
  return std::ranges::all_of(
      pieces, [](const Piece& piece) { return piece.held_motions >= piece.rigid_motions; });
}

const Piece& Connectivity::loose_piece() const {
  return *std::ranges::find(pieces, false, &Piece::held);
}

Connectivity examine_connectivity(const Structure& structure, const GlobalMesh& mesh) {
  return Examination(structure, mesh).run();
}

std::vector<std::pair<GlobalIndex, GlobalIndex>> near_nodes(const GlobalMesh& mesh, double near) {
  constexpr double cell_side = 16;  // in distances
  std::vector<NodeInCell> entries;
  entries.reserve(static_cast<std::size_t>(mesh.node_count()) * 3 / 2);
  for (GlobalIndex node = 0; node < mesh.node_count(); ++node) {
    add_cells(mesh.position(node), cell_side * near, near, node, entries);
  }
  std::ranges::sort(entries);
  std::vector<std::pair<GlobalIndex, GlobalIndex>> pairs;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    for (std::size_t j = i + 1; j < entries.size() && entries[j].cell == entries[i].cell; ++j) {
      if (distance(mesh.position(entries[i].node), mesh.position(entries[j].node)) <= near) {
        pairs.emplace_back(entries[i].node, entries[j].node);
      }
    }
  }
  keep_once(pairs);
  return pairs;
}

}  // namespace pounding
