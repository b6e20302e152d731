#include "mesh/tied_nodes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include "common/disjoint_sets.h"
#include "common/error.h"
#include "common/matrix3.h"
#include "elements/element.h"
#include "mesh/bounding_box.h"
#include "mesh/facet_place.h"

namespace pounding {
namespace {

constexpr std::uint8_t rotations = 0x38;

/// Parts of a facet's longest edge: offsets up to `nothing` are none; places nearer to each other
/// than `same` are one; a node farther than `beside` over the border is doubted.
constexpr double nothing = 1e-13;
constexpr double same = 1e-6;
constexpr double beside = 1e-2;

/// Where a facet turns, arms up to this length are eccentricities of beams and slabs, however fine
/// the mesh [m].
constexpr double longest_arm = 1;

/// Facets of what follows are doubted if so many times longer than those followed.
constexpr double coarser = 1.5;

struct Candidate {
  const Facet* facet = nullptr;
  FacetPlace at;
};

std::string place_text(const Vector3& x) {
  std::ostringstream text;
  text << "(" << x[0] << ", " << x[1] << ", " << x[2] << ")";
  return text.str();
}

/// Elements that bend along a line.
struct Bending {
  bool beam = false;
  std::vector<Vector3> normals;  ///< of shells
};

/// One tie of a structure.
class Tie {
 public:
  Tie(const Structure& structure, int number, GlobalMesh& mesh)
      : rigid_(structure.rigid_groups[static_cast<std::size_t>(number)]),
        number_(number),
        mesh_(mesh),
        option_("option -" + structure.name + "_tie " + rigid_.name()),
        facets_(mesh.groups.at(rigid_.other).facets) {
    if (facets_.empty()) {
      throw UserError(option_ + ": group '" + rigid_.other +
                      "' has no faces or lines of elements to follow");
    }
    for (const Facet& facet : facets_) boxes_.push_back(box_of(facet));
    find_bending();
  }

  std::vector<TiedNode> run() {
    std::vector<TiedNode> found;
    for (const GlobalIndex node : mesh_.groups.at(rigid_.group).nodes) found.push_back(tie(node));
    doubt_overhang();
    doubt_coarse_nodes();
    return found;
  }

  [[noreturn]] void refuse(GlobalIndex node, const std::string& what) const {
    throw UserError(option_ + ": its node at " + place_text(mesh_.position(node)) + " " + what);
  }

 private:
  std::vector<Vector3> corners_of(const Facet& facet) const {
    std::vector<Vector3> corners;
    for (const GlobalIndex node : facet.corners()) corners.push_back(mesh_.position(node));
    return corners;
  }

  BoundingBox box_of(const Facet& facet) const {
    BoundingBox box;
    for (const Vector3& x : corners_of(facet)) {
      for (std::size_t d = 0; d < 3; ++d) {
        box.low[d] = std::min(box.low[d], x[d]);
        box.high[d] = std::max(box.high[d], x[d]);
      }
    }
    return box;
  }

  double longest_edge(const Facet& facet) const {
    const std::vector<Vector3> corners = corners_of(facet);
    double longest = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      longest = std::max(longest, distance(corners[i], corners[(i + 1) % corners.size()]));
    }
    return longest;
  }

  bool turns(const Facet& facet) const {
    return std::ranges::all_of(facet.corners(), [this](GlobalIndex node) {
      return (mesh_.components[node] & rotations) == rotations;
    });
  }

  /// The facet that is nearest, and those that meet it at the place that is nearest.
  std::vector<Candidate> nearest(const Vector3& x) const {
    std::vector<Candidate> found;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      double square = 0;  // of the distance from the box
      for (std::size_t d = 0; d < 3; ++d) {
        const double out = std::max({boxes_[f].low[d] - x[d], x[d] - boxes_[f].high[d], 0.0});
        square += out * out;
      }
      const double margin = same * boxes_[f].diagonal();
      if (std::sqrt(square) > least + margin) continue;
      const Candidate candidate{&facets_[f], nearest_place(corners_of(facets_[f]), x)};
      if (candidate.at.distance > least + margin) continue;
      found.push_back(candidate);
      least = std::min(least, candidate.at.distance);
    }
    const Candidate best = *std::ranges::min_element(
        found, {}, [](const Candidate& candidate) { return candidate.at.distance; });
    const double margin = same * longest_edge(*best.facet);
    std::erase_if(found, [&](const Candidate& candidate) {
      return distance(candidate.at.place, best.at.place) > margin ||
             turns(*candidate.facet) != turns(*best.facet) ||
             candidate.facet->count != best.facet->count;
    });
    return found;
  }

  TiedNode tie(GlobalIndex node) {
    const Vector3 x = mesh_.position(node);
    const std::vector<Candidate> facets = nearest(x);
    check_distance(node, facets.front());
    TiedNode tied{node, number_, {}};
    double size = 0;
    for (const Candidate& candidate : facets) size += candidate.at.size;
    for (const Candidate& candidate : facets) {
      add(candidate, x, candidate.at.size / size, tied);
      longest_followed_ = std::max(longest_followed_, longest_edge(*candidate.facet));
    }
    std::erase_if(tied.carriers, [&](const Carrier& carrier) { return is_idle(carrier, node); });
    check_clamps(tied);
    watch_overhang(facets.front(), x);
    return tied;
  }

  void check_distance(GlobalIndex node, const Candidate& facet) const {
    const double edge = longest_edge(*facet.facet);
    const double reach = turns(*facet.facet) ? std::max(edge, longest_arm) : edge;
    const std::string whose = "the nearest facet of '" + rigid_.other + "'";
    std::ostringstream text;
    if (facet.at.distance > reach) {
      text << "lies " << facet.at.distance << " m from " << whose << ", more than "
           << (reach > edge ? "" : "its longest edge, ") << reach
           << " m: that is no joint; name what lies on it, or let a mesh fill what is between";
      refuse(node, text.str());
    }
    if (facet.facet->count > 2) {
      if (facet.at.normal == Vector3{0, 0, 0}) {
        refuse(node, "would follow a facet of '" + rigid_.other + "' without area");
      }
      return;
    }
    const bool node_turns = (mesh_.components[node] & rotations) != 0;
    if (!turns(*facet.facet) && (node_turns || facet.at.distance > same * edge)) {
      refuse(node, std::string(node_turns ? "turns" : "lies beside its line") +
                       ", but the line of '" + rigid_.other +
                       "' that it would follow has no rotations; name a face");
    }
  }

  /// Adds what the node at x follows of one of several facets that have `weight` together.
  void add(const Candidate& candidate, const Vector3& x, double weight, TiedNode& tied) const {
    Vector3 arm = minus(x, candidate.at.place);
    if (candidate.at.distance <= nothing * longest_edge(*candidate.facet)) arm = {0, 0, 0};
    const bool facet_turns = turns(*candidate.facet);
    for (std::size_t i = 0; i < candidate.facet->corners().size(); ++i) {
      const GlobalIndex corner = candidate.facet->nodes[i];
      auto carrier = std::ranges::find(tied.carriers, corner, &Carrier::node);
      if (carrier == tied.carriers.end()) carrier = tied.carriers.insert(carrier, {corner, {}});
      for (std::size_t j = 0; j < 3; ++j) {
        Vector3 unit{0, 0, 0};
        unit[j] = weight;
        const double share = candidate.at.shares[i];
        carrier->block[6 * j + j] += share * weight;
        const Vector3 turn = facet_turns
                                 ? Vector3{share * unit[0], share * unit[1], share * unit[2]}
                                 : turn_of(candidate.at, i, unit);
        const Vector3 shift = cross(turn, arm);
        const std::size_t column = facet_turns ? 3 + j : j;
        for (std::size_t d = 0; d < 3; ++d) {
          carrier->block[6 * d + column] += shift[d];
          carrier->block[6 * (3 + d) + column] += turn[d];
        }
      }
    }
    if (facet_turns) add_bulges(candidate, weight, tied);
  }

  /// Notes in which directions the lines of the facets bend.
  void find_bending() {
    std::map<std::pair<GlobalIndex, GlobalIndex>, Bending*> bending;
    for (const Facet& facet : facets_) {
      if (facet.count == 2 && turns(facet)) {
        bending[std::minmax(facet.nodes[0], facet.nodes[1])] = &bending_[&facet];
      }
    }
    for (const ElementSet& set : mesh_.regions) {
      const std::size_t width = element_layout(set.type).nodes;
      if (bending.empty() || !(is_beam(set.type) || is_shell(set.type))) continue;
      for (std::size_t first = 0; first < set.connectivity.size(); first += width) {
        const GlobalIndex* const nodes = &set.connectivity[first];
        for (std::size_t a = 0; a < width; ++a) {
          const auto found = bending.find(std::minmax(nodes[a], nodes[(a + 1) % width]));
          if (found == bending.end()) continue;
          if (is_beam(set.type)) found->second->beam = true;
          if (is_shell(set.type)) found->second->normals.push_back(normal_of(nodes, width));
        }
      }
    }
  }

  Vector3 normal_of(const GlobalIndex* nodes, std::size_t width) const {
    const Vector3 x = mesh_.position(nodes[0]);
    return normalised(
        cross(minus(mesh_.position(nodes[1]), x), minus(mesh_.position(nodes[width - 1]), x)));
  }

  /// Part of a bulge that is followed: beams bend in every direction, shells out of their planes.
  Vector3 bent(const Facet& facet, const FacetPlace& at, const Vector3& bulge) const {
    constexpr double parallel = 0.99;
    Vector3 normal = at.normal;
    if (facet.count == 2) {
      const Bending& bending = bending_.at(&facet);
      if (bending.beam) return bulge;
      if (bending.normals.empty()) return {0, 0, 0};
      normal = bending.normals.front();
      if (std::ranges::any_of(bending.normals, [&](const Vector3& other) {
            return std::abs(dot(normal, other)) < parallel;
          })) {
        return bulge;
      }
    }
    const double out = dot(normal, bulge);
    return {out * normal[0], out * normal[1], out * normal[2]};
  }

  /// How far the edges of a facet that turns bend beside their chords.
  void add_bulges(const Candidate& candidate, double weight, TiedNode& tied) const {
    const auto corners = candidate.facet->corners();
    const std::size_t edges = corners.size() == 2 ? 1 : corners.size();
    for (std::size_t i = 0; i < edges; ++i) {
      const double bulge = weight * candidate.at.bulges[i] / 8;
      if (bulge == 0) continue;
      const GlobalIndex from = corners[i];
      const GlobalIndex to = corners[(i + 1) % corners.size()];
      const Vector3 edge = minus(mesh_.position(to), mesh_.position(from));
      for (const GlobalIndex corner : {from, to}) {
        Carrier& carrier = *std::ranges::find(tied.carriers, corner, &Carrier::node);
        for (std::size_t j = 0; j < 3; ++j) {
          Vector3 turn{0, 0, 0};
          turn[j] = corner == from ? bulge : -bulge;
          const Vector3 shift = bent(*candidate.facet, candidate.at, cross(turn, edge));
          for (std::size_t d = 0; d < 3; ++d) carrier.block[6 * d + 3 + j] += shift[d];
        }
      }
    }
  }

  /// Turn of a face, at its place, for a displacement of corner i.
  static Vector3 turn_of(const FacetPlace& at, std::size_t i, const Vector3& u) {
    const Vector3 tilt = cross(at.gradients[i], at.normal);
    const double out = dot(at.normal, u);
    const double drill = dot(cross(at.normal, at.gradients[i]), u) / 2;
    Vector3 turn{};
    for (std::size_t d = 0; d < 3; ++d) turn[d] = tilt[d] * out + at.normal[d] * drill;
    return turn;
  }

  /// Whether nothing of a carrier reaches a node.
  bool is_idle(const Carrier& carrier, GlobalIndex node) const {
    const std::size_t rows = (mesh_.components[node] & rotations) != 0 ? 6 : 3;
    return std::all_of(carrier.block.begin(), carrier.block.begin() + 6 * rows,
                       [](double value) { return value == 0; });
  }

  /// A clamped component may follow clamped ones alone.
  void check_clamps(const TiedNode& tied) const {
    const unsigned clamped = mesh_.components[tied.node] & ~mesh_.free_components[tied.node];
    for (std::size_t c = 0; c < 6; ++c) {
      if ((clamped >> c & 1) == 0) continue;
      for (const Carrier& carrier : tied.carriers) {
        for (std::size_t k = 0; k < 6; ++k) {
          if ((mesh_.free_components[carrier.node] >> k & 1) != 0 &&
              carrier.block[6 * c + k] != 0) {
            refuse(tied.node, "is clamped in what would follow '" + rigid_.other +
                                  "', which is free; leave it out of '" + rigid_.group +
                                  "', or clamp both");
          }
        }
      }
    }
  }

  void watch_overhang(const Candidate& facet, const Vector3& x) {
    if (facet.facet->count == 2) return;
    const Vector3 arm = minus(x, facet.at.place);
    const double up = dot(arm, facet.at.normal);
    const double out = std::sqrt(std::max(0.0, dot(arm, arm) - up * up));
    if (out > beside * longest_edge(*facet.facet)) {
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

  void doubt_coarse_nodes() const {
    double longest = 0;
    for (const Facet& facet : mesh_.groups.at(rigid_.group).facets) {
      if (facet.count > 2 && facets_.front().count == 2) continue;  // it is followed along a line
      longest = std::max(longest, longest_edge(facet));
    }
    if (longest <= coarser * longest_followed_) return;
    std::ostringstream text;
    text << option_ << ": the facets of '" << rigid_.group << "' are up to " << longest
         << " m long, those that they follow " << longest_followed_
         << " m: nodes between are left alone; let the finer mesh follow the coarser one";
    mesh_.doubts.push_back(text.str());
  }

  const RigidGroup& rigid_;
  int number_;
  GlobalMesh& mesh_;
  std::string option_;
  const std::vector<Facet>& facets_;
  std::vector<BoundingBox> boxes_;           ///< of the facets
  std::map<const Facet*, Bending> bending_;  ///< of lines that turn
  double longest_followed_ = 0;              ///< edge of a facet that a node follows [m]
  GlobalIndex overhanging_ = 0;              ///< nodes beside the border
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
    std::ranges::sort(part.nodes);
    part.nodes.erase(std::unique(part.nodes.begin(), part.nodes.end()), part.nodes.end());
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
