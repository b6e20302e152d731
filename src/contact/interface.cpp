#include "contact/interface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.h"
#include "common/parallel.h"
#include "contact/contact_face.h"

namespace pounding {
namespace {

/// A weight this close to 1 is the node itself; one this close to 0 is not there.
constexpr double snap = 1e-6;

/// How far outside a facet, relative to its size, a node may lie and still face it.
constexpr double facet_tolerance = 1e-6;

std::size_t structure_index(const Scene& scene, const std::string& name) {
  for (std::size_t s = 0; s < scene.structures.size(); ++s) {
    if (scene.structures[s].name == name) {
      return s;
    }
  }
  throw UserError("contact: structure '" + name + "' is not in the scene");
}

/// Bounding boxes of facets across the normal, so that few of them are met in earnest.
class FacetFinder {
 public:
  FacetFinder(const GlobalMesh& mesh, const ContactFace& face) : mesh_(mesh), face_(face) {
    for (const Facet& facet : face.facets) {
      Vector3 low = mesh.position(facet.nodes[0]);
      Vector3 high = low;
      for (const GlobalIndex node : facet.corners()) {
        const Vector3 x = mesh.position(node);
        for (std::size_t d = 0; d < 3; ++d) {
          low[d] = std::min(low[d], x[d]);
          high[d] = std::max(high[d], x[d]);
        }
      }
      radius_.push_back(std::sqrt(dot(minus(high, low), minus(high, low))) / 2);
      centre_.push_back({(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2});
    }
  }

  /// The facet met nearest to `origin`, looking both ways: faces may overlap initially.
  std::optional<std::pair<std::size_t, FacetPoint>> find(const Vector3& origin,
                                                         const Vector3& direction) const {
    std::optional<std::pair<std::size_t, FacetPoint>> best;
    for (std::size_t f = 0; f < face_.facets.size(); ++f) {
      const Vector3 to = minus(centre_[f], origin);
      const double along = dot(to, direction);
      const double across = std::sqrt(std::max(0.0, dot(to, to) - along * along));
      if (across > 1.01 * radius_[f]) {
        continue;
      }
      const auto point = meet_facet(mesh_, face_.facets[f], origin, direction, facet_tolerance);
      if (point && (!best || std::abs(point->distance) <
                                 std::abs(best->second.distance) - 1e-9 * radius_[f])) {
        best = {f, *point};
      }
    }
    return best;
  }

 private:
  const GlobalMesh& mesh_;
  const ContactFace& face_;
  std::vector<Vector3> centre_;
  std::vector<double> radius_;
};

/// Finds the pairs of one contact.
class PairFinder {
 public:
  PairFinder(const Scene& scene, std::span<const GlobalMesh> meshes, int contact)
      : contact_(scene.contacts[static_cast<std::size_t>(contact)]),
        number_(contact),
        secondary_structure_(structure_index(scene, contact_.secondary.structure)),
        primary_structure_(structure_index(scene, contact_.primary.structure)),
        secondary_mesh_(meshes[secondary_structure_]),
        primary_mesh_(meshes[primary_structure_]),
        secondary_(face_of("secondary", contact_.secondary, secondary_mesh_)),
        primary_(face_of("primary", contact_.primary, primary_mesh_)) {
    check_facing();
    find_tangent_axes();
  }

  void find(Interface& interface) {
    const std::size_t first = interface.constraints.size();
    const FacetFinder finder(primary_mesh_, primary_);
    for (std::size_t i = 0; i < secondary_.nodes.size(); ++i) {
      const auto found =
          finder.find(secondary_mesh_.position(secondary_.nodes[i]), secondary_.node_normals[i]);
      if (!found) {
        ++report_.unmatched_nodes;
        continue;
      }
      add(i, found->first, found->second, interface);
    }
    if (interface.constraints.size() == first) {
      throw UserError(where("secondary") + ": no node of group '" + contact_.secondary.group +
                      "' faces group '" + contact_.primary.group +
                      "'; check that the two faces overlap across their normal");
    }
    set_gaps({&interface.constraints[first], interface.constraints.size() - first});
    report_.contact = contact_.name;
    report_.normal = secondary_.mean_normal;
    interface.reports.push_back(report_);
  }

 private:
  std::string where(const char* side) const {
    const ContactSide& s = side == std::string("secondary") ? contact_.secondary : contact_.primary;
    return "option -" + contact_.name + "_" + side + " " + s.structure + ":" + s.group;
  }

  ContactFace face_of(const char* side, const ContactSide& s, const GlobalMesh& mesh) const {
    const auto found = mesh.groups.find(s.group);
    if (found == mesh.groups.end()) {
      std::string names;
      for (const auto& [name, group] : mesh.groups) {
        names += (names.empty() ? "" : ", ") + name;
      }
      throw UserError(where(side) + ": group '" + s.group + "' is not in the mesh of " +
                      s.structure + ", which has: " + names);
    }
    ContactFace face = build_contact_face(mesh, found->second);
    if (face.facets.empty()) {
      throw UserError(where(side) + ": group '" + s.group +
                      "' has no surface facets on solid elements; name a physical surface");
    }
    if (std::all_of(face.nodes.begin(), face.nodes.end(), [&](GlobalIndex node) {
          return mesh.free_components[static_cast<std::size_t>(node)] == 0;
        })) {
      throw UserError(where(side) + ": every node of group '" + s.group +
                      "' is clamped; a contact needs a face that can move");
    }
    return face;
  }

  void check_facing() const {
    const double cosine = dot(secondary_.mean_normal, primary_.mean_normal);
    if (!(cosine < -0.5)) {
      throw UserError(where("secondary") + " and -" + contact_.name + "_primary " +
                      contact_.primary.structure + ":" + contact_.primary.group +
                      ": the faces do not face each other (cosine of their outward normals " +
                      std::to_string(cosine) + ", should be near -1)");
    }
  }

  void find_tangent_axes() {
    int normal_axis = 0;
    for (int d = 1; d < 3; ++d) {
      if (std::abs(secondary_.mean_normal[static_cast<std::size_t>(d)]) >
          std::abs(secondary_.mean_normal[static_cast<std::size_t>(normal_axis)]) + 1e-9) {
        normal_axis = d;
      }
    }
    report_.tangent_axes = {normal_axis == 0 ? 1 : 0, normal_axis == 2 ? 1 : 2};
  }

  void add(std::size_t i, std::size_t facet, FacetPoint point, Interface& interface) {
    const Facet& primary = primary_.facets[facet];
    const Vector3& normal = secondary_.node_normals[i];
    Constraint constraint;
    constraint.contact = number_;
    const auto count = static_cast<std::size_t>(primary.count);
    for (std::size_t a = 0; a < count; ++a) {
      if (point.weights[a] > 1 - snap) {
        constraint.matched = true;
        std::fill(point.weights.begin(), point.weights.end(), 0.0);
        point.weights[a] = 1;
      }
    }
    for (std::size_t a = 0; a < count; ++a) {
      if (std::abs(point.weights[a]) > snap) {
        add_terms(static_cast<int>(primary_structure_), primary.nodes[a], point.weights[a], normal,
                  constraint);
      }
    }
    add_terms(static_cast<int>(secondary_structure_), secondary_.nodes[i], -1, normal, constraint);
    constraint.geometric_gap = point.distance;
    const Vector3 x = secondary_mesh_.position(secondary_.nodes[i]);
    for (std::size_t t = 0; t < 2; ++t) {
      constraint.place[t] = x[static_cast<std::size_t>(report_.tangent_axes[t])];
    }
    ++report_.pairs;
    report_.matched += constraint.matched ? 1 : 0;
    interface.constraints.push_back(std::move(constraint));
  }

  static void add_terms(int structure, GlobalIndex node, double weight, const Vector3& normal,
                        Constraint& constraint) {
    for (int d = 0; d < 3; ++d) {
      const double coefficient = weight * normal[static_cast<std::size_t>(d)];
      if (coefficient != 0) {
        constraint.terms.push_back({structure, node, d, coefficient});
      }
    }
  }

  /// The gap that the user gave, interpolated between the corners of the face.
  double given_gap(const std::array<double, 2>& s) const {
    const std::vector<double>& g = contact_.gap.values;
    if (g.size() == 1) {
      return g[0];
    }
    if (g.size() == 2) {
      return g[0] * (1 - s[0]) + g[1] * s[0];
    }
    return (g[0] * (1 - s[0]) + g[1] * s[0]) * (1 - s[1]) +
           (g[3] * (1 - s[0]) + g[2] * s[0]) * s[1];
  }

  void set_gaps(std::span<Constraint> constraints) {
    std::array<double, 2> low{1e300, 1e300};
    std::array<double, 2> high{-1e300, -1e300};
    for (const GlobalIndex node : secondary_.nodes) {
      const Vector3 x = secondary_mesh_.position(node);
      for (std::size_t t = 0; t < 2; ++t) {
        const double value = x[static_cast<std::size_t>(report_.tangent_axes[t])];
        low[t] = std::min(low[t], value);
        high[t] = std::max(high[t], value);
      }
    }
    report_.smallest_gap = std::numeric_limits<double>::max();
    report_.largest_gap = -report_.smallest_gap;
    for (Constraint& constraint : constraints) {
      std::array<double, 2> s{};
      for (std::size_t t = 0; t < 2; ++t) {
        s[t] = high[t] > low[t] ? (constraint.place[t] - low[t]) / (high[t] - low[t]) : 0;
      }
      constraint.initial_gap =
          contact_.gap.values.empty() ? constraint.geometric_gap : given_gap(s);
      report_.smallest_gap = std::min(report_.smallest_gap, constraint.initial_gap);
      report_.largest_gap = std::max(report_.largest_gap, constraint.initial_gap);
    }
  }

  const Contact& contact_;
  int number_;
  std::size_t secondary_structure_;
  std::size_t primary_structure_;
  const GlobalMesh& secondary_mesh_;
  const GlobalMesh& primary_mesh_;
  ContactFace secondary_;
  ContactFace primary_;
  InterfaceReport report_;
};

double extent(std::span<const GlobalMesh> meshes) {
  Vector3 low{1e300, 1e300, 1e300};
  Vector3 high{-1e300, -1e300, -1e300};
  for (const GlobalMesh& mesh : meshes) {
    for (GlobalIndex node = 0; node < mesh.node_count(); ++node) {
      const Vector3 x = mesh.position(node);
      for (std::size_t d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], x[d]);
        high[d] = std::max(high[d], x[d]);
      }
    }
  }
  return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
}

}  // namespace

Interface find_interface(const Scene& scene, std::span<const GlobalMesh> meshes) {
  Interface interface;
  interface.model_size = extent(meshes);
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    PairFinder(scene, meshes, static_cast<int>(c)).find(interface);
  }
  return interface;
}

std::vector<NodeLink> facing_nodes(const Interface& interface) {
  std::vector<NodeLink> links;
  for (const Constraint& constraint : interface.constraints) {
    const ConstraintTerm& secondary = constraint.terms.back();
    for (const ConstraintTerm& term : constraint.terms) {
      if (term.structure != secondary.structure || term.node != secondary.node) {
        links.push_back({secondary.structure, secondary.node, term.structure, term.node});
      }
    }
  }
  return links;
}

void broadcast_interface(MPI_Comm comm, Interface& interface) {
  std::vector<ConstraintTerm> terms;
  struct Head {
    int contact;
    int terms;
    int matched;
    double initial_gap;
    double geometric_gap;
    std::array<double, 2> place;
  };
  std::vector<Head> heads;
  for (const Constraint& c : interface.constraints) {
    heads.push_back({c.contact, static_cast<int>(c.terms.size()), c.matched ? 1 : 0, c.initial_gap,
                     c.geometric_gap, c.place});
    terms.insert(terms.end(), c.terms.begin(), c.terms.end());
  }
  broadcast_array(comm, heads);
  broadcast_array(comm, terms);
  MPI_Bcast(&interface.model_size, 1, MPI_DOUBLE, 0, comm);
  if (rank_of(comm) == 0) {
    return;
  }
  auto next = terms.begin();
  interface.constraints.clear();
  for (const Head& head : heads) {
    interface.constraints.push_back({head.contact,
                                     {next, next + head.terms},
                                     head.initial_gap,
                                     head.geometric_gap,
                                     head.place,
                                     head.matched != 0});
    next += head.terms;
  }
}

}  // namespace pounding
