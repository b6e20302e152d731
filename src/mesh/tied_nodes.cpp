#include "mesh/tied_nodes.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/error.h"
#include "common/facts.h"
#include "common/integer_sets.h"
#include "common/matrix3.h"
#include "mesh/followed_facets.h"
#include "mesh/mortar.h"

namespace pounding {
namespace {

/// Parts of a facet's longest edge: a node farther than `beside` over the border is doubted; beside
/// a line farther than `at_line` it is refused.
constexpr double at_line = 1e-6;
constexpr double beside = 1e-2;

/// Facets of nodes that follow at their places are doubted if so many times longer than those
/// followed.
constexpr double coarser = 1.5;

/// One tie of a structure.
class Tie {
 public:
  Tie(const Structure& structure, int number, GlobalMesh& mesh)
      : rigid_(structure.rigid_groups[static_cast<std::size_t>(number)]),
        number_(number),
        mesh_(mesh),
        option_("option -" + structure.name + "_tie " + rigid_.name()),
        facets_(mesh, mesh.groups.at(rigid_.other).facets) {
    refuse_if(facets_.all().empty(), option_ + ": group '" + rigid_.other +
                                         "' has no faces or lines of elements to follow");
  }

  std::vector<TiedNode> run() {
    const NodeGroup& group = mesh_.groups.at(rigid_.group);
    std::map<GlobalIndex, TiedNode> places;
    for (const GlobalIndex node : group.nodes) places[node] = at_place(node);
    const auto means = mortar_rows(mesh_, group.facets, facets_, places);
    std::vector<TiedNode> found;
    for (const auto& [node, place] : places) {
      const auto mean = means.find(node);
      found.push_back(mean == means.end() ? place : joined(place, mean->second));
      check_clamps(found.back());
    }
    doubt_overhang();
    doubt_coarse_nodes(means);
    return found;
  }

  [[noreturn]] void refuse(GlobalIndex node, const std::string& what) const {
    throw UserError(option_ + ": its node at " + place_text(mesh_.position(node)) + " " + what);
  }

 private:
  /// The row of a node that follows at its place.
  TiedNode at_place(GlobalIndex node) {
    const Vector3 x = mesh_.position(node);
    const std::vector<FollowedPoint> facets = facets_.nearest(x);
    check_distance(node, facets.front());
    TiedNode tied{node, number_, {}};
    double size = 0;
    for (const FollowedPoint& followed : facets) size += followed.at.size;
    for (const FollowedPoint& followed : facets) {
      facets_.follow(followed, x, followed.at.size / size, tied.carriers);
      longest_followed_ = std::max(longest_followed_, facets_.longest_edge(*followed.facet));
    }
    std::erase_if(tied.carriers, [&](const Carrier& carrier) { return is_idle(carrier, node); });
    watch_overhang(facets.front(), x);
    return tied;
  }

  /// The row `mean`, but clamped components follow at their place: nodes on one plane of symmetry
  /// follow nodes on it.
  TiedNode joined(const TiedNode& place, TiedNode mean) const {
    for (std::size_t c = 0; c < 6; ++c) {
      if ((mesh_.clamped(place.node) >> c & 1) == 0) continue;
      for (Carrier& carrier : mean.carriers) std::fill_n(&carrier.block[6 * c], 6, 0.0);
      for (const Carrier& carrier : place.carriers) {
        std::copy_n(&carrier.block[6 * c], 6,
                    &carrier_of(carrier.node, mean.carriers).block[6 * c]);
      }
    }
    return mean;
  }

  void check_distance(GlobalIndex node, const FollowedPoint& facet) const {
    const double edge = facets_.longest_edge(*facet.facet);
    const double reach = facets_.reach(*facet.facet);
    const std::string whose = "the nearest facet of '" + rigid_.other + "'";
    if (facet.at.distance > reach) {
      refuse(node,
             sentence("lies {} m from {}, more than {}{} m: that is no joint; name the nodes "
                      "on it, or let a mesh fill the space between",
                      {facet.at.distance, whose, reach > edge ? "" : "its longest edge, ", reach}));
    }
    if (facet.facet->count > 2) {
      if (facet.at.normal == Vector3{0, 0, 0}) {
        refuse(node, "would follow a facet of '" + rigid_.other + "' without area");
      }
      return;
    }
    const bool node_turns = (mesh_.components[node] & rotation_bits) != 0;
    if (!facets_.turns(*facet.facet) && (node_turns || facet.at.distance > at_line * edge)) {
      refuse(node, std::string(node_turns ? "turns" : "lies beside its line") +
                       ", but the line of '" + rigid_.other +
                       "' that it would follow has no rotations; name a face");
    }
  }

  /// Whether nothing of a carrier reaches a node.
  bool is_idle(const Carrier& carrier, GlobalIndex node) const {
    const std::size_t rows = (mesh_.components[node] & rotation_bits) != 0 ? 6 : 3;
    return std::all_of(carrier.block.begin(), carrier.block.begin() + 6 * rows,
                       [](double value) { return value == 0; });
  }

  /// A clamped component may follow clamped ones alone.
  void check_clamps(const TiedNode& tied) const {
    for (std::size_t c = 0; c < 6; ++c) {
      if ((mesh_.clamped(tied.node) >> c & 1) == 0) continue;
      for (const Carrier& carrier : tied.carriers) {
        for (std::size_t k = 0; k < 6; ++k) {
          if ((mesh_.free_components[carrier.node] >> k & 1) != 0 &&
              carrier.block[6 * c + k] != 0) {
            refuse(tied.node, "is clamped in components that would follow '" + rigid_.other +
                                  "', which is free; leave it out of '" + rigid_.group +
                                  "', or clamp both");
          }
        }
      }
    }
  }

  void watch_overhang(const FollowedPoint& facet, const Vector3& x) {
    if (facet.facet->count == 2) return;
    const Vector3 arm = minus(x, facet.at.x);
    const double up = dot(arm, facet.at.normal);
    const double out = std::sqrt(std::max(0.0, dot(arm, arm) - up * up));
    if (out > beside * facets_.longest_edge(*facet.facet)) {
      if (overhanging_++ == 0) first_over_ = x;
    }
  }

  void doubt_overhang() const {
    if (overhanging_ == 0) return;
    mesh_.doubts.push_back(option_ + ": " + std::to_string(overhanging_) +
                           " of its nodes lie beside the border of '" + rigid_.other +
                           "', the first at " + place_text(first_over_) +
                           ", and follow it over that distance");
  }

  /// Doubts facets of nodes that follow at their places.
  void doubt_coarse_nodes(const std::map<GlobalIndex, TiedNode>& means) const {
    double longest = 0;
    for (const Facet& facet : mesh_.groups.at(rigid_.group).facets) {
      // It is followed along a line, or follows as a whole.
      if (facet.count > 2 && facets_.all().front().count == 2) continue;
      if (std::ranges::all_of(facet.corners(), [&](auto node) { return means.contains(node); })) {
        continue;
      }
      longest = std::max(longest, facets_.longest_edge(facet));
    }
    if (longest <= coarser * longest_followed_) return;
    mesh_.doubts.push_back(
        sentence("{}: the facets of '{}' are up to {} m long, those that they follow {} m: nodes "
                 "between are left alone; let the finer mesh follow the coarser one",
                 {option_, rigid_.group, longest, longest_followed_}));
  }

  const RigidGroup& rigid_;
  int number_;
  GlobalMesh& mesh_;
  std::string option_;
  FollowedFacets facets_;
  double longest_followed_ = 0;  ///< edge of a facet that a node follows [m]
  GlobalIndex overhanging_ = 0;  ///< nodes beside the border
  Vector3 first_over_{0, 0, 0};
};

/// Neighbours of a tie: which tie every tied node follows first, and the rigid group of nodes.
struct Others {
  std::map<GlobalIndex, int> follows;
  std::map<GlobalIndex, std::string> body_of;
};

/// Refuses nodes that follow two things, or something that follows itself.
void check_chains(const Tie& tie, const std::vector<TiedNode>& tied, const GlobalMesh& mesh,
                  const Others& others) {
  for (const TiedNode& one : tied) {
    if (others.follows.at(one.node) != one.group) {
      tie.refuse(one.node, "follows another tie already");
    }
    if (others.body_of.contains(one.node)) {
      tie.refuse(one.node,
                 "is in rigid group " + others.body_of.at(one.node) + ", which it cannot leave");
    }
    for (const Carrier& carrier : one.carriers) {
      if (carrier.node == one.node) {
        tie.refuse(one.node, "is on the facet that it would follow: the mesh joins them already");
      }
      if (others.follows.contains(carrier.node)) {
        tie.refuse(one.node, "would follow the node at " + place_text(mesh.position(carrier.node)) +
                                 ", which follows a facet itself; turn one of the ties round");
      }
      if (others.body_of.contains(carrier.node)) {
        tie.refuse(one.node, "would follow rigid group " + others.body_of.at(carrier.node) +
                                 "; put it into that group instead");
      }
    }
  }
}

/// Parts of all ties that share no node.
std::vector<RigidNodes> parts_of(const Structure& structure, const GlobalMesh& mesh,
                                 const std::vector<TiedNode>& all) {
  DisjointSets sets(static_cast<std::size_t>(mesh.node_count()));
  for (const TiedNode& tied : all) {
    for (const Carrier& carrier : tied.carriers) {
      sets.join(static_cast<std::size_t>(tied.node), static_cast<std::size_t>(carrier.node));
    }
  }
  std::map<std::size_t, RigidNodes> parts;  // by root
  for (const TiedNode& tied : all) {
    RigidNodes& part = parts[sets.root(static_cast<std::size_t>(tied.node))];
    part.kind = RigidKind::tie;
    const std::string name = structure.rigid_groups[static_cast<std::size_t>(tied.group)].name();
    if (part.group.empty()) part.group = name;
    part.nodes.push_back(tied.node);
    for (const Carrier& carrier : tied.carriers) part.nodes.push_back(carrier.node);
    part.tied.push_back(tied);
  }
  std::vector<RigidNodes> result;
  for (auto& [root, part] : parts) {
    keep_once(part.nodes);
    std::erase_if(part.nodes, [&](GlobalIndex node) { return mesh.free_components[node] == 0; });
    if (!part.nodes.empty()) result.push_back(std::move(part));
  }
  return result;
}

}  // namespace

void add_tied_nodes(const Structure& structure, GlobalMesh& mesh) {
  std::vector<std::pair<Tie, std::vector<TiedNode>>> ties;
  Others others;
  for (const RigidNodes& body : mesh.rigid) {
    for (const GlobalIndex node : body.nodes) others.body_of[node] = body.group;
  }
  std::vector<TiedNode> all;
  for (std::size_t r = 0; r < structure.rigid_groups.size(); ++r) {
    if (structure.rigid_groups[r].kind != RigidKind::tie) continue;
    Tie tie(structure, static_cast<int>(r), mesh);
    std::vector<TiedNode> tied = tie.run();
    for (const TiedNode& one : tied) others.follows.try_emplace(one.node, static_cast<int>(r));
    all.insert(all.end(), tied.begin(), tied.end());
    ties.emplace_back(std::move(tie), std::move(tied));
  }
  for (const auto& [tie, tied] : ties) check_chains(tie, tied, mesh, others);
  for (RigidNodes& part : parts_of(structure, mesh, all)) mesh.rigid.push_back(std::move(part));
}

}  // namespace pounding
