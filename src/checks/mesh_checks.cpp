#include "checks/mesh_checks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "common/error.h"
#include "common/integer_sets.h"
#include "common/matrix3.h"

namespace pounding {
namespace {

/// Name in -<structure>_ignore for elements in no physical group.
constexpr const char* ungrouped = "ungrouped";

/// Longer structures are meshes in millimetres, or in feet.
constexpr double longest_structure = 500;  // m

/// Part of the diagonal of a structure by which a point may lie outside of it.
constexpr double outside = 0.05;

/// Joins are beams and slabs that lie on each other.
constexpr double longest_join = 1;  // m

/// Flexibility of a cantilever by shear, which some beams leave out, over that by bending.
constexpr double doubted_shear = 0.05;

/// Part of a section that bears shear: that of a rectangle, more than webs and tubes have.
constexpr double shear_part = 5.0 / 6;

/// Share of shear in a cantilever in its first mode over that in a member held at both ends:
/// frequencies of the former by bending and by shear alone are 3.516 (E I / m)^1/2 / L2 and
/// pi / 2 (kappa G A / m)^1/2 / L.
constexpr double cantilever_part = 3.516 * 3.516 / (std::numbers::pi * std::numbers::pi / 4) / 12;

/// Beams are in one line whose directions turn by less than about 2.5 degrees.
constexpr double in_line = 0.999;

std::string found_at(const Places& places, const char* what) {
  return std::to_string(places.count) + what + place_text(places.first);
}

/// Groups that clamps, rigid groups, soil, pools, contacts, supports, loads and probes name, and
/// those left out.
std::set<std::string> named_groups(const Scene& scene, const Structure& structure) {
  std::set<std::string> names(structure.ignored_groups.begin(), structure.ignored_groups.end());
  for (const Clamp& clamp : structure.clamps) names.insert(clamp.group);
  if (structure.soil) names.insert(structure.soil->mat);
  for (const Pool& pool : structure.pools) names.insert(pool.faces.begin(), pool.faces.end());
  for (const AbsorbingFace& face : structure.absorbing) names.insert(face.group);
  for (const RigidGroup& rigid : structure.rigid_groups) {
    names.insert(rigid.group);
    names.insert(rigid.other);
  }
  for (const Contact& contact : scene.contacts) {
    for (const ContactSide& side : {contact.secondary, contact.primary}) {
      if (side.structure == structure.name) names.insert(side.group);
    }
  }
  for (const Support& support : scene.supports) {
    for (const SupportedGroup& group : support.groups) {
      if (group.structure == structure.name && !group.is_all_ground()) names.insert(group.group);
    }
  }
  for (const Load& load : scene.loads) {
    if (load.structure == structure.name) names.insert(load.group);
  }
  for (const Probe& probe : scene.probes) {
    if (probe.structure == structure.name) names.insert(probe.group);
  }
  return names;
}

/// Whether a region of the structure has a group's name, be it for elements of another dimension.
bool is_region(const Structure& structure, const std::string& group) {
  return std::ranges::find(structure.regions, group, &Region::group) != structure.regions.end();
}

[[noreturn]] void refuse_unused(const Structure& structure, const UnusedElements& unused) {
  const std::string count = std::to_string(unused.left_out) + " element" +
                            (unused.left_out == 1 ? "" : "s") + " (" + unused.kind + ")";
  const std::string place = ", the first at " + place_text(unused.place);
  const std::string option = "-" + structure.name + "_";
  refuse_if(is_region(structure, unused.group),
            "structure " + structure.name + ": group '" + unused.group + "' of " + structure.mesh +
                " has " + count + place + ", beside those that become " + "elements by " + option +
                unused.group + "_element: they would be left out; give them a name of their own");
  refuse_if(unused.group.empty(), "structure " + structure.name + ": " + structure.mesh + " has " +
                                      count + " in no physical group" + place +
                                      ": they would be left out; put them into a group, or give " +
                                      option + "ignore " + ungrouped);
  throw UserError("structure " + structure.name + ": group '" + unused.group + "' of " +
                  structure.mesh + " has " + count + " that no option uses" + place +
                  ": they would be left out; give " + option + unused.group + "_element, or name " +
                  "it in " + option + "ignore");
}

bool is_zero(const Vector3& vector) {
  return vector == Vector3{0, 0, 0};
}

bool starts_in_motion(const Structure& structure) {
  return structure.starts_in_motion() || structure.starts_displaced();
}

/// A block that rests on another by its weight.
bool may_rest(const Scene& scene, const Structure& structure) {
  const auto touches = [&](const Contact& contact) {
    return contact.secondary.structure == structure.name ||
           contact.primary.structure == structure.name;
  };
  return !is_zero(structure.gravity) && std::ranges::any_of(scene.contacts, touches);
}

bool may_fly(const Scene& scene, const Structure& structure) {
  const bool shaken =
      !scene.supports.empty() || !scene.loads.empty() ||
      std::ranges::any_of(scene.motion, [](const auto& d) { return d.has_value(); });
  return !shaken || starts_in_motion(structure) || may_rest(scene, structure);
}

[[noreturn]] void refuse_loose(const Structure& structure, const std::string& what) {
  throw UserError("structure " + structure.name + ": " + what + ", or give -" + structure.name +
                  "_allow_loose if that is meant");
}

/// Doubt about joins whose nodes are far apart: the nearest node may not be the one meant.
void doubt_long_joins(const Structure& structure, const GlobalMesh& mesh, Doubts doubts) {
  double longest = longest_join;
  const RigidNodes* found = nullptr;
  for (const RigidNodes& body : mesh.rigid) {
    if (body.kind != RigidKind::join) continue;
    const Vector3 x = mesh.position(body.nodes.front());
    for (const GlobalIndex node : body.nodes) {
      const double apart = distance(x, mesh.position(node));
      if (apart > longest) {
        longest = apart;
        found = &body;
      }
    }
  }
  if (found == nullptr) return;
  doubts.add("structure " + structure.name,
             "join {} holds nodes {} m apart together, one at {}; is the nearest node of "
             "the second group the one that is meant?",
             {found->group, longest, place_text(mesh.position(found->nodes.front()))});
}

/// Doubt about embedded foundations of this structure alone that turn about a point outside of it.
void doubt_turning_points(const Scene& scene, const Structure& structure, const BoundingBox& box,
                          Doubts doubts) {
  const double reach = outside * box.diagonal();
  for (const Support& support : scene.supports) {
    if (!support.embedment) continue;
    bool is_out = false;
    for (std::size_t d = 0; d < 3; ++d) {
      is_out =
          is_out || support.point[d] < box.low[d] - reach || support.point[d] > box.high[d] + reach;
    }
    const bool alone = std::ranges::all_of(support.groups, [&](const SupportedGroup& group) {
      return group.structure == structure.name;
    });
    if (!alone || !is_out) continue;
    doubts.add("support " + support.name,
               "it turns about {}, outside of structure {}, which lies between {} and {}; give "
               "-{}_point the middle of its underside",
               {place_text(support.point), structure.name, place_text(box.low),
                place_text(box.high), support.name});
  }
}

/// Lengths of the straight lines of beams of any region, through all joints, that the beams of a
/// mesh lie in [m]; set by set.
std::vector<double> line_lengths(const GlobalMesh& mesh) {
  struct End {
    std::size_t beam;
    Vector3 towards;
  };
  std::map<GlobalIndex, std::vector<End>> ends;
  std::vector<double> lengths;
  for (const ElementSet& set : mesh.regions) {
    for (std::size_t e = 0; is_beam(set.type) && e < set.tags.size(); ++e) {
      const GlobalIndex first = set.connectivity[2 * e];
      const GlobalIndex second = set.connectivity[2 * e + 1];
      const Vector3 along = minus(mesh.position(second), mesh.position(first));
      const Vector3 back = minus(mesh.position(first), mesh.position(second));
      ends[first].push_back({lengths.size(), normalised(along)});
      ends[second].push_back({lengths.size(), normalised(back)});
      lengths.push_back(norm(along));
    }
  }
  DisjointSets lines(lengths.size());
  for (const auto& [node, at] : ends) {
    for (std::size_t i = 0; i < at.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (dot(at[i].towards, at[j].towards) < -in_line) lines.join(at[i].beam, at[j].beam);
      }
    }
  }
  std::vector<double> whole(lengths.size());
  for (std::size_t b = 0; b < lengths.size(); ++b) whole[lines.root(b)] += lengths[b];
  for (std::size_t b = 0; b < lengths.size(); ++b) lengths[b] = whole[lines.root(b)];
  return lengths;
}

/// Doubt about regions of beams without flexibility in shear whose longest line is thick.
void doubt_slenderness(const Structure& structure, const GlobalMesh& mesh, Doubts doubts) {
  const std::vector<double> lengths = line_lengths(mesh);
  std::map<int, double> longest;  // of each region
  std::size_t b = 0;
  for (const ElementSet& set : mesh.regions) {
    for (std::size_t e = 0; is_beam(set.type) && e < set.tags.size(); ++e) {
      longest[set.region] = std::max(longest[set.region], lengths[b++]);
    }
  }
  for (const auto& [r, length] : longest) {
    const Region& region = structure.regions[static_cast<std::size_t>(r)];
    if (is_flexible_in_shear(region)) continue;
    const Section& section = *region.section;
    const double slenderness =
        length / std::sqrt(std::max(section.inertia_y, section.inertia_z) / section.area);
    // 12 E I / (kappa G A L2)
    const double held = 24 * (1 + region.material.poisson) / shear_part / std::pow(slenderness, 2);
    if (cantilever_part * held < doubted_shear) continue;
    doubts.add(
        "structure " + structure.name + ", group " + region.group,
        "slenderness {:.3g}, its beams being {:.4g} m long in one line: shear, which "
        "they leave out, would make that {:.3g} % more flexible held at both ends, "
        "{:.3g} % as a cantilever; {}",
        {slenderness, length, 100 * held, 100 * cantilever_part * held,
         region.element == ElementType::beam ? "give section " + section.name + " a shear_area"
                                             : "let its element be beam, with shear areas"});
  }
}

}  // namespace

void check_export(const Scene& scene, const Structure& structure, const GlobalMesh& mesh) {
  if (!mesh.rigid.empty() && !scene.export_matrices.empty()) {
    throw UserError("option -export_matrices " + scene.export_matrices + ": structure " +
                    structure.name + " has " +
                    (mesh.rigid.front().kind == RigidKind::tie ? "tie " : "rigid group ") +
                    mesh.rigid.front().group + ", of which no matrix tells");
  }
}

std::vector<UnusedElements> check_unused(const Scene& scene, const Structure& structure,
                                         const GlobalMesh& mesh) {
  for (const std::string& name : structure.ignored_groups) {
    refuse_if(
        name != ungrouped && !mesh.groups.contains(name),
        "option -" + structure.name + "_ignore: group '" + name + "' is not in " + structure.mesh);
  }
  const std::set<std::string> named = named_groups(scene, structure);
  std::vector<UnusedElements> places;
  for (const UnusedElements& unused : mesh.unused) {
    const std::string name = unused.group.empty() ? ungrouped : unused.group;
    const bool left_out = unused.left_out > 0 && structure.matrices.empty();
    const bool ignored =
        std::ranges::find(structure.ignored_groups, name) != structure.ignored_groups.end();
    if (left_out && !ignored && is_region(structure, name)) refuse_unused(structure, unused);
    if (named.contains(name)) continue;
    if (left_out) refuse_unused(structure, unused);
    if (!unused.group.empty()) places.push_back(unused);
  }
  return places;
}

void check_connectivity(const Scene& scene, const Structure& structure,
                        const Connectivity& connectivity) {
  if (structure.allow_loose) return;
  if (connectivity.coincident_apart.count > 0) {
    refuse_loose(
        structure,
        found_at(connectivity.coincident_apart,
                 " pairs of nodes of pieces that nothing joins lie on each other, the first at ") +
            "; make them one node (Coherence in a .geo file)");
  }
  if (connectivity.ends_inside.count > 0) {
    refuse_loose(structure,
                 found_at(connectivity.ends_inside,
                          " ends of lines lie in an element without a node of it, the first at ") +
                     "; let the mesh have a node there that both share");
  }
  if (connectivity.nothing_held() && !may_fly(scene, structure)) {
    refuse_loose(structure, "nothing holds it to the ground, and it is shaken or pushed; give -" +
                                structure.name + "_clamp or grounded springs");
  }
  if (connectivity.loose_pieces() > 0 && !connectivity.nothing_held() &&
      !starts_in_motion(structure)) {
    const Piece& piece = connectivity.loose_piece();
    refuse_loose(structure,
                 std::to_string(connectivity.loose_pieces()) + " of its " +
                     std::to_string(connectivity.pieces.size()) +
                     " pieces are neither held nor joined to another, the largest with " +
                     std::to_string(piece.nodes) + " nodes, one at " + place_text(piece.place) +
                     "; join or clamp them");
  }
}

void add_mesh_doubts(const Scene& scene, const Structure& structure, const GlobalMesh& mesh,
                     const Connectivity& connectivity, Doubts doubts) {
  if (connectivity.coincident_inside.count > 0 && !structure.allow_loose) {
    doubts.add("structure " + structure.name, "{}",
               {found_at(connectivity.coincident_inside,
                         " pairs of nodes lie on each other and are not one, the first at ")});
  }
  doubt_long_joins(structure, mesh, doubts);
  const BoundingBox box = bounding_box({&mesh, 1});
  doubt_turning_points(scene, structure, box, doubts);
  if (structure.matrices.empty()) doubt_slenderness(structure, mesh, doubts);
  doubts.add(mesh.doubts);
  const double longest = box.longest_side();
  if (longest > longest_structure) {
    doubts.add("structure " + structure.name,
               "its mesh is {} m long; meshes are in metres, is this one in millimetres?",
               {longest});
  }
}

}  // namespace pounding
