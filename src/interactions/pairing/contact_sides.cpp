#include "interactions/pairing/contact_sides.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/error.h"
#include "mesh/global_mesh.h"

namespace pounding::interactions {
namespace {

/// Share of its distance by which a structure lies on one side of a face.
constexpr double off_the_plane = 1e-6;

double shell_thickness(const Structure& structure) {
  double thickness = 0;
  for (const Region& region : structure.regions) thickness = std::max(thickness, region.thickness);
  return thickness;
}

/// Finds the two sides of one contact.
class SideFinder {
 public:
  SideFinder(const Scene& scene, std::span<const GlobalMesh> meshes, const Contact& contact)
      : scene_(scene), meshes_(meshes), contact_(contact) {}

  ContactSides find() {
    ContactSides sides;
    sides.secondary = side_of("secondary", contact_.secondary);
    if (contact_.primary.is_wall()) {
      decide_beside_wall(sides.secondary);
      return sides;
    }
    sides.primary = side_of("primary", contact_.primary);
    refuse_common_nodes(sides);
    decide(sides);
    turn_towards_other(sides.secondary, contact_.secondary, contact_.primary);
    turn_towards_other(sides.primary, contact_.primary, contact_.secondary);
    check_beams(sides);
    check_facing(sides);
    return sides;
  }

 private:
  const GlobalMesh& mesh(const ContactSide& side) const {
    return meshes_[structure_number(scene_, side.structure)];
  }
  const NodeGroup& group(const ContactSide& side) const { return mesh(side).groups.at(side.group); }
  Vector3 centre(const ContactSide& side) const { return centroid(mesh(side), group(side).nodes); }

  FaceSide side_of(const std::string& name, const ContactSide& s) const {
    const std::size_t index = structure_number(scene_, s.structure);
    const GlobalMesh& mesh = meshes_[index];
    refuse_if(!mesh.groups.contains(s.group), side_option(contact_, name) + ": group '" + s.group +
                                                  "' is not in the mesh of " + s.structure +
                                                  ", which has: " + group_names(mesh));
    const Structure& structure = scene_.structures[index];
    FaceSide side{static_cast<int>(index), &mesh,
                  build_contact_face(mesh, structure.regions, group(s)),
                  shell_thickness(structure)};
    if (side.face.facets.empty() && side.face.undecided.empty()) {
      throw UserError(
          side_option(contact_, name) + ": group '" + s.group +
          "' has no faces of solids or shells, no edges of shells and no beams; its nodes can "
          "be a stop: give -" +
          contact_.name + "_along, a direction x,y,z or line");
    }
    const bool decided = side.face.undecided.empty();
    if (std::ranges::all_of(decided ? side.face.nodes : group(s).nodes,
                            [&](GlobalIndex node) { return mesh.free_components[node] == 0; })) {
      throw UserError(side_option(contact_, name) + ": every node of group '" + s.group +
                      "' is clamped; a contact needs a face that can move");
    }
    return side;
  }

  void refuse_common_nodes(const ContactSides& sides) const {
    if (sides.secondary.structure != sides.primary.structure) return;
    const std::vector<GlobalIndex>& a = group(contact_.secondary).nodes;
    const std::vector<GlobalIndex>& b = group(contact_.primary).nodes;
    std::vector<GlobalIndex> common;
    std::ranges::set_intersection(a, b, std::back_inserter(common));
    refuse_if(!common.empty(),
              side_option(contact_, "primary") + ": shares " + std::to_string(common.size()) +
                  " nodes with the secondary side " + contact_.secondary.structure + ":" +
                  contact_.secondary.group + "; a contact needs two faces that can part");
  }

  /// Builds a face anew, its facets turned towards a direction where that is open.
  void decide(FaceSide& side, const ContactSide& s, const Vector3& towards) const {
    if (!side.face.undecided.empty()) {
      const auto& regions = scene_.structures[side.structure].regions;
      side.face = build_contact_face(*side.mesh, regions, group(s), towards);
    }
  }

  void decide_beside_wall(FaceSide& side) const {
    refuse_if(side.face.facets.empty(),
              side_option(contact_, "secondary") +
                  ": beams look in no direction, or shells in several planes end at the edges "
                  "of this group, so that nothing "
                  "says on which side the wall is; give a face of shells, or an edge of one "
                  "floor alone");
    decide(side, contact_.secondary, side.face.mean_normal);
    // Shells have two sides: a mat is on the wall, its load on the other one.
    const Vector3 body = centre_of_body(contact_.secondary);
    if (leaves_plane(side, body)) turn_towards(side.face, behind(side.face, body));
  }

  Vector3 centre_of_body(const ContactSide& side) const {
    std::vector<GlobalIndex> all(mesh(side).node_count());
    std::iota(all.begin(), all.end(), 0);
    return centroid(mesh(side), all);
  }

  /// The point on the other side of a face.
  static Vector3 behind(const ContactFace& face, const Vector3& point) {
    return minus(face.centroid, minus(point, face.centroid));
  }

  /// Whether a point lies on one side of a face, beyond round-off of its coordinates.
  static bool leaves_plane(const FaceSide& side, const Vector3& point) {
    const Vector3 way = minus(point, side.face.centroid);
    double size = norm(way);
    for (const GlobalIndex node : side.face.nodes) {
      size = std::max(size, norm(minus(side.mesh->position(node), side.face.centroid)));
    }
    return std::abs(dot(way, side.face.mean_normal)) > off_the_plane * size;
  }

  /// Shells look at the other side. Where that lies in their plane they look away from the rest of
  /// their structure, or towards the rest of the other one.
  void turn_towards_other(FaceSide& side, const ContactSide& own, const ContactSide& other) const {
    const auto& two_sided = side.face.two_sided;
    if (std::ranges::none_of(two_sided, [](char open) { return open != 0; })) return;
    if (leaves_plane(side, centre(other))) return turn_towards(side.face, centre(other));
    const bool apart = own.structure != other.structure;
    if (apart && leaves_plane(side, centre_of_body(own))) {
      return turn_towards(side.face, behind(side.face, centre_of_body(own)));
    }
    if (apart && leaves_plane(side, centre_of_body(other))) {
      return turn_towards(side.face, centre_of_body(other));
    }
    throw UserError(side_option(contact_, "secondary") + " and -" + contact_.name + "_primary " +
                    contact_.primary.structure + ":" + contact_.primary.group +
                    ": the shells lie in one plane, and nothing beside it says which of its sides "
                    "each one looks to; place them apart, if only by a hundredth of their gap");
  }

  /// Facets that several elements hold: they look where the rest of their own face looks, else
  /// against the other face, else along the normal across which the two sides lie farthest apart.
  void decide(ContactSides& sides) const {
    FaceSide& secondary = sides.secondary;
    FaceSide& primary = sides.primary;
    for (const auto& [side, s] :
         {std::pair(&secondary, &contact_.secondary), std::pair(&primary, &contact_.primary)}) {
      if (!side->face.facets.empty()) decide(*side, *s, side->face.mean_normal);
    }
    if (!primary.face.facets.empty()) {
      turn_towards_other(primary, contact_.primary, contact_.secondary);
      decide(secondary, contact_.secondary, opposite(primary.face.mean_normal));
    } else if (!secondary.face.facets.empty()) {
      turn_towards_other(secondary, contact_.secondary, contact_.primary);
      decide(primary, contact_.primary, opposite(secondary.face.mean_normal));
    } else {
      const Vector3 apart = *std::ranges::max_element(
          secondary.face.undecided, {}, [&](const Vector3& n) { return separation(sides, n); });
      decide(secondary, contact_.secondary, apart);
      decide(primary, contact_.primary, opposite(apart));
    }
  }

  static Vector3 opposite(const Vector3& a) { return {-a[0], -a[1], -a[2]}; }

  /// How far the structures (of one structure: the groups) lie apart along a unit vector, from the
  /// secondary to the primary; negative where they overlap [m].
  double separation(const ContactSides& sides, const Vector3& along) const {
    const bool whole = sides.secondary.structure != sides.primary.structure;
    const auto extent = [&](const ContactSide& side, double sign) {
      const GlobalMesh& of = mesh(side);
      std::vector<GlobalIndex> nodes = group(side).nodes;
      if (whole) {
        nodes.resize(of.node_count());
        std::iota(nodes.begin(), nodes.end(), 0);
      }
      double farthest = std::numeric_limits<double>::lowest();
      for (const GlobalIndex node : nodes) {
        farthest = std::max(farthest, sign * dot(along, of.position(node)));
      }
      return farthest;
    };
    return -extent(contact_.primary, -1) - extent(contact_.secondary, 1);
  }

  /// A beam's line says nothing of its surface, and a face has no place for where it is met.
  void check_beams(const ContactSides& sides) const {
    if (sides.secondary.face.beams == 0 && sides.primary.face.beams == 0) return;
    refuse_if(contact_.gap.is_of_meshes(),
              "option -" + contact_.name +
                  "_gap geometry: one side is beams, whose lines say nothing of their surface; "
                  "give the gap as a number");
    refuse_if(sides.primary.face.beams > 0 && !sides.secondary.face.is_line(),
              side_option(contact_, "primary") +
                  ": beams before a face are its secondary side; swap the two");
  }

  void check_facing(const ContactSides& sides) const {
    const double cosine = dot(sides.secondary.face.mean_normal, sides.primary.face.mean_normal);
    refuse_if(!(cosine < -0.5),
              side_option(contact_, "secondary") + " and -" + contact_.name + "_primary " +
                  contact_.primary.structure + ":" + contact_.primary.group +
                  ": the faces do not face each other (cosine of their outward normals " +
                  std::to_string(cosine) + ", should be near -1)");
  }

  const Scene& scene_;
  std::span<const GlobalMesh> meshes_;
  const Contact& contact_;
};

}  // namespace

std::string side_option(const Contact& contact, const std::string& side) {
  const ContactSide& s = side == "secondary" ? contact.secondary : contact.primary;
  return "option -" + contact.name + "_" + side + " " + s.structure + ":" + s.group;
}

ContactSides find_sides(const Scene& scene, std::span<const GlobalMesh> meshes,
                        const Contact& contact) {
  return SideFinder(scene, meshes, contact).find();
}

}  // namespace pounding::interactions
