#include "contact/interface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.h"
#include "common/parallel.h"
#include "contact/contact_face.h"
#include "mesh/bounding_box.h"
#include "mesh/group_names.h"

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
  FacetFinder(const GlobalMesh& mesh, const ContactFace& face, double reach)
      : mesh_(mesh), face_(face), reach_(reach) {
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
      if (across > 1.01 * radius_[f] + reach_) {
        continue;
      }
      const auto point =
          meet_facet(mesh_, face_.facets[f], origin, direction, facet_tolerance, reach_);
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
  double reach_;
  std::vector<Vector3> centre_;
  std::vector<double> radius_;
};

/// One side of a contact with what is known of its structure.
struct Side {
  int structure = 0;
  const GlobalMesh* mesh = nullptr;
  ContactFace face;
  double thickness = 0;  ///< of its thickest shell [m]
};

double shell_thickness(const Structure& structure) {
  double thickness = 0;
  for (const Region& region : structure.regions) {
    thickness = std::max(thickness, region.thickness);
  }
  return thickness;
}

/// Finds the pairs of one contact.
class PairFinder {
 public:
  PairFinder(const Scene& scene, std::span<const GlobalMesh> meshes, int contact)
      : contact_(scene.contacts[static_cast<std::size_t>(contact)]), number_(contact) {
    secondary_ = side_of(scene, meshes, "secondary", contact_.secondary);
    if (!contact_.primary.is_wall()) {
      primary_ = side_of(scene, meshes, "primary", contact_.primary);
      turn_towards(secondary_.face, primary_.face.centroid);
      turn_towards(primary_.face, secondary_.face.centroid);
      check_facing();
    }
    find_tangent_axes();
  }

  void find(Interface& interface) {
    const std::size_t first = interface.constraints.size();
    if (contact_.primary.is_wall()) {
      pair_with_wall(interface);
    } else {
      pair(secondary_, primary_, interface);
      if (contact_.passes == 2) {
        pair(primary_, secondary_, interface);
      }
    }
    if (interface.constraints.size() == first) {
      throw UserError(where("secondary") + ": no node of group '" + contact_.secondary.group +
                      "' faces group '" + contact_.primary.group +
                      "'; check that the two faces overlap across their normal");
    }
    set_gaps({&interface.constraints[first], interface.constraints.size() - first});
    report_.contact = contact_.name;
    report_.normal = secondary_.face.mean_normal;
    interface.reports.push_back(report_);
  }

 private:
  std::string where(const std::string& side) const {
    const ContactSide& s = side == "secondary" ? contact_.secondary : contact_.primary;
    return "option -" + contact_.name + "_" + side + " " + s.structure + ":" + s.group;
  }

  Side side_of(const Scene& scene, std::span<const GlobalMesh> meshes, const std::string& name,
               const ContactSide& s) const {
    const std::size_t index = structure_index(scene, s.structure);
    const GlobalMesh& mesh = meshes[index];
    const auto found = mesh.groups.find(s.group);
    if (found == mesh.groups.end()) {
      throw UserError(where(name) + ": group '" + s.group + "' is not in the mesh of " +
                      s.structure + ", which has: " + group_names(mesh));
    }
    Side side{static_cast<int>(index), &mesh, build_contact_face(mesh, found->second),
              shell_thickness(scene.structures[index])};
    if (side.face.facets.empty()) {
      throw UserError(where(name) + ": group '" + s.group +
                      "' has no faces of solids or shells and no edges of shells");
    }
    if (std::all_of(side.face.nodes.begin(), side.face.nodes.end(), [&](GlobalIndex node) {
          return mesh.free_components[static_cast<std::size_t>(node)] == 0;
        })) {
      throw UserError(where(name) + ": every node of group '" + s.group +
                      "' is clamped; a contact needs a face that can move");
    }
    return side;
  }

  void check_facing() const {
    const double cosine = dot(secondary_.face.mean_normal, primary_.face.mean_normal);
    if (!(cosine < -0.5)) {
      throw UserError(where("secondary") + " and -" + contact_.name + "_primary " +
                      contact_.primary.structure + ":" + contact_.primary.group +
                      ": the faces do not face each other (cosine of their outward normals " +
                      std::to_string(cosine) + ", should be near -1)");
    }
  }

  void find_tangent_axes() {
    int normal_axis = 0;
    const Vector3& normal = secondary_.face.mean_normal;
    for (int d = 1; d < 3; ++d) {
      if (std::abs(normal[static_cast<std::size_t>(d)]) >
          std::abs(normal[static_cast<std::size_t>(normal_axis)]) + 1e-9) {
        normal_axis = d;
      }
    }
    report_.tangent_axes = {normal_axis == 0 ? 1 : 0, normal_axis == 2 ? 1 : 2};
  }

  /// Keeps the nodes of one side out of the facets of the other.
  void pair(const Side& nodes, const Side& facets, Interface& interface) {
    const double reach = (nodes.thickness + facets.thickness) / 2;
    const FacetFinder finder(*facets.mesh, facets.face, reach);
    for (std::size_t i = 0; i < nodes.face.nodes.size(); ++i) {
      const auto found =
          finder.find(nodes.mesh->position(nodes.face.nodes[i]), nodes.face.node_normals[i]);
      if (found) {
        add_pair(nodes, i, facets, facets.face.facets[found->first], found->second, interface);
      } else {
        ++report_.unmatched_nodes;
      }
    }
  }

  void pair_with_wall(Interface& interface) {
    for (std::size_t i = 0; i < secondary_.face.nodes.size(); ++i) {
      Constraint constraint;
      constraint.matched = true;
      finish(secondary_, i, std::move(constraint), interface);
    }
  }

  void add_pair(const Side& nodes, std::size_t i, const Side& facets, const Facet& facet,
                FacetPoint point, Interface& interface) {
    const Vector3& normal = nodes.face.node_normals[i];
    Constraint constraint;
    const auto count = static_cast<std::size_t>(facet.count);
    for (std::size_t a = 0; a < count; ++a) {
      if (point.weights[a] > 1 - snap) {
        constraint.matched = true;
        std::fill(point.weights.begin(), point.weights.end(), 0.0);
        point.weights[a] = 1;
      }
    }
    for (std::size_t a = 0; a < count; ++a) {
      if (std::abs(point.weights[a]) > snap) {
        add_terms(facets.structure, facet.nodes[a], point.weights[a], normal, constraint);
      }
    }
    constraint.geometric_gap = point.distance;
    finish(nodes, i, std::move(constraint), interface);
  }

  /// Adds the node's own terms and the place, and keeps the constraint.
  void finish(const Side& nodes, std::size_t i, Constraint&& constraint, Interface& interface) {
    const GlobalIndex node = nodes.face.nodes[i];
    constraint.contact = number_;
    add_terms(nodes.structure, node, -1, nodes.face.node_normals[i], constraint);
    const Vector3 x = nodes.mesh->position(node);
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

  /// The gap that the user gave, interpolated between the corners of the secondary face.
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
    for (const GlobalIndex node : secondary_.face.nodes) {
      const Vector3 x = secondary_.mesh->position(node);
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
  Side secondary_;
  Side primary_;
  InterfaceReport report_;
};

}  // namespace

Interface find_interface(const Scene& scene, std::span<const GlobalMesh> meshes) {
  Interface interface;
  interface.model_size = bounding_box(meshes).longest_side();
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
