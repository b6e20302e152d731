#include "interactions/pairing/contact_face.h"

#include <array>
#include <map>

#include "interactions/pairing/facet_backing.h"

namespace pounding::interactions {
namespace {

/// The element behind a facet; null where several may be and no direction chooses.
const Backing* element_towards(const FacetBacking& behind, const std::optional<Vector3>& towards) {
  const std::vector<std::size_t> outer = behind.outer();
  if (outer.size() > 1 && !towards) return nullptr;
  const auto cosine = [&](std::size_t i) {
    return towards ? dot(normalised(behind.elements[i].area), *towards) : 0.0;
  };
  return &behind.elements[*std::ranges::max_element(outer, {}, cosine)];
}

/// Normals of the nodes and of the whole, from the areas of the facets.
void settle_normals(ContactFace& face) {
  std::map<GlobalIndex, Vector3> sums;
  Vector3 total{0, 0, 0};
  for (std::size_t f = 0; f < face.facets.size(); ++f) {
    for (std::size_t d = 0; d < 3; ++d) {
      total[d] += face.facet_areas[f][d];
      for (const GlobalIndex node : face.facets[f].corners()) {
        sums[node][d] += face.facet_areas[f][d];
      }
    }
  }
  face.nodes.clear();
  face.node_normals.clear();
  for (const auto& [node, sum] : sums) {
    face.nodes.push_back(node);
    Vector3 normal = normalised(sum);
    for (double& component : normal) {
      // Round-off of a face along an axis would couple components that have nothing to do with it.
      if (std::abs(component) < 1e-12) component = 0;
    }
    face.node_normals.push_back(normalised(normal));
  }
  face.mean_normal = normalised(total);
}

void turn(Vector3& area) {
  area = {-area[0], -area[1], -area[2]};
}

/// Shells with a common edge look to the same side, in whatever order the mesh has their nodes.
void align_shells(ContactFace& face) {
  const std::vector<char> reversed = reversed_shells(face.facets, face.two_sided);
  for (std::size_t f = 0; f < face.facets.size(); ++f) {
    if (reversed[f] != 0) turn(face.facet_areas[f]);
  }
}

/// All values of the nodes, from those of the facets.
void settle_nodes(const GlobalMesh& mesh, ContactFace& face) {
  settle_normals(face);
  std::map<GlobalIndex, double> half_thickness;
  std::map<GlobalIndex, double> depth;
  for (std::size_t f = 0; f < face.facets.size(); ++f) {
    for (const GlobalIndex node : face.facets[f].corners()) {
      half_thickness[node] = std::max(half_thickness[node], face.facet_half_thickness[f]);
      depth[node] = std::max(depth[node], face.facet_depth[f]);
    }
  }
  for (const GlobalIndex node : face.nodes) {
    face.node_half_thickness.push_back(half_thickness[node]);
    face.node_depth.push_back(depth[node]);
  }
  if (!face.nodes.empty()) face.centroid = centroid(mesh, face.nodes);
}

std::optional<FacetIntersection> meet_edge(const GlobalMesh& mesh, const Facet& facet,
                                           const Vector3& origin, const Vector3& direction,
                                           double tolerance, double reach) {
  const Vector3 start = minus(mesh.position(facet.nodes[0]), origin);
  const Vector3 edge = minus(mesh.position(facet.nodes[1]), mesh.position(facet.nodes[0]));
  const Vector3 flat_start = part_across(start, direction);
  const Vector3 flat_edge = part_across(edge, direction);
  const double square = dot(flat_edge, flat_edge);
  if (!(square > 0)) return std::nullopt;
  const double s = -dot(flat_start, flat_edge) / square;
  const Vector3 miss{flat_start[0] + s * flat_edge[0], flat_start[1] + s * flat_edge[1],
                     flat_start[2] + s * flat_edge[2]};
  const double length = std::sqrt(square);
  if (s < -tolerance || s > 1 + tolerance ||
      std::sqrt(dot(miss, miss)) > reach + tolerance * length) {
    return std::nullopt;
  }
  return FacetIntersection{{1 - s, s, 0, 0}, dot(start, direction) + s * dot(edge, direction)};
}

/// The part of a vector across a facet of two nodes, of unit length; zero where it lies along it.
Vector3 across_axis(const GlobalMesh& mesh, const Facet& facet, const Vector3& v) {
  const Vector3 axis =
      normalised(minus(mesh.position(facet.nodes[1]), mesh.position(facet.nodes[0])));
  const Vector3 across = part_across(v, axis);
  return dot(across, across) > 1e-6 ? normalised(across) : Vector3{0, 0, 0};
}

/// Adds the axis of a beam as a facet that looks against nothing yet, or `towards`.
void add_axis(const GlobalMesh& mesh, const Facet& facet, const std::optional<Vector3>& towards,
              ContactFace& face) {
  if (!towards) {
    for (const double sign : {1.0, -1.0}) {
      for (std::size_t d = 0; d < 3; ++d) {
        Vector3 axis{0, 0, 0};
        axis[d] = sign;
        const Vector3 normal = across_axis(mesh, facet, axis);
        if (dot(normal, axis) > 0.9) face.undecided.push_back(normal);
      }
    }
    return;
  }
  const Vector3 normal = across_axis(mesh, facet, *towards);
  if (dot(normal, normal) == 0) return;  // it points at the other side
  const Vector3 axis = minus(mesh.position(facet.nodes[1]), mesh.position(facet.nodes[0]));
  const double length = norm(axis);
  face.facets.push_back(facet);
  face.facet_areas.push_back({length * normal[0], length * normal[1], length * normal[2]});
  face.two_sided.push_back(0);
  face.facet_half_thickness.push_back(0);
  face.facet_half_width.push_back(0);
  face.facet_depth.push_back(length);
  ++face.beams;
}

/// Shares of a carrier that are none.
constexpr double nothing = 1e-9;

/// Whether a carrier displaces its follower at its own place, apart from turning it.
bool displaces(const Carrier& carrier) {
  return std::ranges::any_of(std::array{0, 7, 14},
                             [&](std::size_t k) { return std::abs(carrier.block[k]) > nothing; });
}

}  // namespace

ContactFace build_contact_face(const GlobalMesh& mesh, std::span<const Region> regions,
                               const NodeGroup& group, const std::optional<Vector3>& towards) {
  ContactFace face;
  const std::vector<FacetBacking> behind = elements_behind(mesh, regions, group.facets);
  for (std::size_t f = 0; f < group.facets.size(); ++f) {
    if (behind[f].elements.empty()) continue;
    if (behind[f].elements.front().beam) {
      add_axis(mesh, group.facets[f], towards, face);
      continue;
    }
    const Backing* const element = element_towards(behind[f], towards);
    if (element == nullptr) {
      for (const std::size_t i : behind[f].outer()) {
        face.undecided.push_back(normalised(behind[f].elements[i].area));
      }
      continue;
    }
    face.inner_facets += behind[f].is_inner() ? 1 : 0;
    face.facets.push_back(group.facets[f]);
    face.facet_areas.push_back(element->area);
    face.two_sided.push_back(element->two_sided ? 1 : 0);
    face.facet_half_thickness.push_back(behind[f].half_thickness(normalised(element->area)));
    const auto nodes = group.facets[f].corners();
    const Vector3 along = minus(mesh.position(nodes[1]), mesh.position(nodes[0]));
    face.facet_half_width.push_back(
        nodes.size() == 2 ? behind[f].half_thickness(normalised(cross(along, element->area))) : 0);
    face.facet_depth.push_back(element->depth);
  }
  align_shells(face);
  settle_nodes(mesh, face);
  return face;
}

double ContactFace::mean_facet_size() const {
  double sum = 0;
  for (std::size_t f = 0; f < facets.size(); ++f) sum += facet_size(f);
  return sum / static_cast<double>(facets.size());
}

void turn_towards(ContactFace& face, const Vector3& point) {
  Vector3 normal{0, 0, 0};
  for (std::size_t f = 0; f < face.facets.size(); ++f) {
    for (std::size_t d = 0; d < 3; ++d) {
      normal[d] += face.two_sided[f] != 0 ? face.facet_areas[f][d] : 0.0;
    }
  }
  if (dot(normal, minus(point, face.centroid)) >= 0) return;
  for (std::size_t f = 0; f < face.facets.size(); ++f) {
    if (face.two_sided[f] != 0) turn(face.facet_areas[f]);
  }
  settle_normals(face);
}

std::optional<FacetIntersection> meet_corners(std::span<const Vector3> corners,
                                              const Vector3& origin, const Vector3& direction,
                                              double tolerance) {
  // Newton on x(xi, eta) - origin - distance * direction = 0; exact in one step on a triangle.
  const bool triangle = corners.size() == 3;
  double xi = triangle ? 1.0 / 3 : 0;
  double eta = xi;
  FacetIntersection point;
  for (int iteration = 0; iteration < 20; ++iteration) {
    std::array<double, 4> along_xi{};
    std::array<double, 4> along_eta{};
    if (triangle) {
      point.weights = {1 - xi - eta, xi, eta, 0};
      along_xi = {-1, 1, 0, 0};
      along_eta = {-1, 0, 1, 0};
    } else {
      point.weights = {(1 - xi) * (1 - eta) / 4, (1 + xi) * (1 - eta) / 4, (1 + xi) * (1 + eta) / 4,
                       (1 - xi) * (1 + eta) / 4};
      along_xi = {-(1 - eta) / 4, (1 - eta) / 4, (1 + eta) / 4, -(1 + eta) / 4};
      along_eta = {-(1 - xi) / 4, -(1 + xi) / 4, (1 + xi) / 4, (1 - xi) / 4};
    }
    Vector3 offset{-origin[0], -origin[1], -origin[2]};
    Vector3 tangent_xi{0, 0, 0};
    Vector3 tangent_eta{0, 0, 0};
    for (std::size_t a = 0; a < corners.size(); ++a) {
      const Vector3& x = corners[a];
      for (std::size_t d = 0; d < 3; ++d) {
        offset[d] += point.weights[a] * x[d];
        tangent_xi[d] += along_xi[a] * x[d];
        tangent_eta[d] += along_eta[a] * x[d];
      }
    }
    point.distance = dot(offset, direction);
    // Solve tangent_xi dxi + tangent_eta deta = -(part of offset across the line).
    const Vector3 normal = cross(tangent_xi, tangent_eta);
    const double determinant = dot(normal, direction);
    if (std::abs(determinant) < 1e-12 * std::sqrt(dot(normal, normal))) return std::nullopt;
    const double step_xi = -dot(cross(offset, tangent_eta), direction) / determinant;
    const double step_eta = -dot(cross(tangent_xi, offset), direction) / determinant;
    if (!(std::abs(step_xi) < 1e3) || !(std::abs(step_eta) < 1e3)) return std::nullopt;
    if (std::abs(step_xi) + std::abs(step_eta) < 1e-14) break;
    xi += step_xi;
    eta += step_eta;
  }
  const double outside =
      triangle ? std::max({-xi, -eta, xi + eta - 1}) : std::max(std::abs(xi), std::abs(eta)) - 1;
  if (outside > tolerance) return std::nullopt;
  return point;
}

std::optional<FacetIntersection> meet_facet(const GlobalMesh& mesh, const Facet& facet,
                                            const Vector3& origin, const Vector3& direction,
                                            double tolerance, double reach) {
  if (facet.count == 2) return meet_edge(mesh, facet, origin, direction, tolerance, reach);
  std::array<Vector3, 4> corners{};
  const auto count = static_cast<std::size_t>(facet.count);
  for (std::size_t a = 0; a < count; ++a) corners[a] = mesh.position(facet.nodes[a]);
  return meet_corners(std::span(corners).first(count), origin, direction, tolerance);
}

std::vector<char> carried_nodes(const GlobalMesh& mesh, const ContactFace& face,
                                const std::vector<char>& has_row) {
  std::map<GlobalIndex, std::size_t> number;
  for (std::size_t i = 0; i < face.nodes.size(); ++i) number[face.nodes[i]] = i;
  std::vector<char> carried(face.nodes.size(), 0);
  for (const RigidNodes& part : mesh.rigid) {
    for (const TiedNode& tied : part.tied) {
      const auto own = number.find(tied.node);
      if (own == number.end()) continue;
      carried[own->second] = std::ranges::all_of(tied.carriers, [&](const Carrier& carrier) {
        const auto other = number.find(carrier.node);
        return mesh.free_components[carrier.node] == 0 || !displaces(carrier) ||
               (other != number.end() && has_row[other->second] != 0);
      });
    }
  }
  return carried;
}

}  // namespace pounding::interactions
