#include "contact/contact_face.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "elements/element.h"

namespace pounding {
namespace {

Vector3 centroid(const GlobalMesh& mesh, std::span<const GlobalIndex> nodes) {
  Vector3 sum{0, 0, 0};
  for (const GlobalIndex node : nodes) {
    const Vector3 x = mesh.position(node);
    for (std::size_t d = 0; d < 3; ++d) {
      sum[d] += x[d] / static_cast<double>(nodes.size());
    }
  }
  return sum;
}

/// Twice the facet's area along its normal, for the node order of the facet.
Vector3 area_vector(const GlobalMesh& mesh, const Facet& facet) {
  const auto at = [&](std::size_t i) { return mesh.position(facet.nodes[i]); };
  if (facet.count == 3) {
    return cross(minus(at(1), at(0)), minus(at(2), at(0)));
  }
  return cross(minus(at(2), at(0)), minus(at(3), at(1)));
}

bool carries_faces(ElementType type) {
  return is_hexahedron(type) || is_shell(type);
}

/// The element behind a facet.
struct Backing {
  bool found = false;
  bool same_nodes = false;  ///< the facet is a whole shell element
  Vector3 centroid{0, 0, 0};
};

/// For every facet the solid or shell element that holds all its nodes.
std::vector<Backing> bodies_behind(const GlobalMesh& mesh, const std::vector<Facet>& facets) {
  std::map<GlobalIndex, std::vector<std::size_t>> facets_at;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (const GlobalIndex node : facets[f].corners()) {
      facets_at[node].push_back(f);
    }
  }
  std::vector<Backing> behind(facets.size());
  for (const ElementSet& set : mesh.regions) {
    if (!carries_faces(set.type)) {
      continue;
    }
    const auto width = static_cast<std::size_t>(element_layout(set.type).nodes);
    for (std::size_t e = 0; e < set.tags.size(); ++e) {
      const std::span<const GlobalIndex> nodes(&set.connectivity[e * width], width);
      std::map<std::size_t, int> shared;
      for (const GlobalIndex node : nodes) {
        const auto found = facets_at.find(node);
        if (found != facets_at.end()) {
          for (const std::size_t f : found->second) {
            ++shared[f];
          }
        }
      }
      for (const auto& [f, count] : shared) {
        // A shell face is turned to the other side of the contact, an edge of a solid is no face.
        if (count == facets[f].count && (count > 2 || is_shell(set.type))) {
          behind[f] = {true, static_cast<std::size_t>(count) == width, centroid(mesh, nodes)};
        }
      }
    }
  }
  return behind;
}

/// Area (length for an edge) of a facet along its outward normal.
Vector3 outward_area(const GlobalMesh& mesh, const Facet& facet, const Backing& backing) {
  const Vector3 out = minus(centroid(mesh, facet.corners()), backing.centroid);
  if (facet.count == 2) {
    const Vector3 edge = minus(mesh.position(facet.nodes[1]), mesh.position(facet.nodes[0]));
    const double length = std::sqrt(dot(edge, edge));
    const Vector3 along = normalised(edge);
    const double part = dot(out, along);
    const Vector3 normal =
        normalised({out[0] - part * along[0], out[1] - part * along[1], out[2] - part * along[2]});
    return {length * normal[0], length * normal[1], length * normal[2]};
  }
  const Vector3 area = area_vector(mesh, facet);
  return dot(area, out) < 0 ? Vector3{-area[0], -area[1], -area[2]} : area;
}

std::optional<FacetPoint> meet_edge(const GlobalMesh& mesh, const Facet& facet,
                                    const Vector3& origin, const Vector3& direction,
                                    double tolerance, double reach) {
  const auto across = [&](const Vector3& v) {
    const double part = dot(v, direction);
    return Vector3{v[0] - part * direction[0], v[1] - part * direction[1],
                   v[2] - part * direction[2]};
  };
  const Vector3 start = minus(mesh.position(facet.nodes[0]), origin);
  const Vector3 edge = minus(mesh.position(facet.nodes[1]), mesh.position(facet.nodes[0]));
  const Vector3 flat_start = across(start);
  const Vector3 flat_edge = across(edge);
  const double square = dot(flat_edge, flat_edge);
  if (!(square > 0)) {
    return std::nullopt;
  }
  const double s = -dot(flat_start, flat_edge) / square;
  const Vector3 miss{flat_start[0] + s * flat_edge[0], flat_start[1] + s * flat_edge[1],
                     flat_start[2] + s * flat_edge[2]};
  const double length = std::sqrt(square);
  if (s < -tolerance || s > 1 + tolerance ||
      std::sqrt(dot(miss, miss)) > reach + tolerance * length) {
    return std::nullopt;
  }
  return FacetPoint{{1 - s, s, 0, 0}, dot(start, direction) + s * dot(edge, direction)};
}

}  // namespace

double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector3 minus(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Vector3 normalised(const Vector3& a) {
  const double length = std::sqrt(dot(a, a));
  return length > 0 ? Vector3{a[0] / length, a[1] / length, a[2] / length} : a;
}

ContactFace build_contact_face(const GlobalMesh& mesh, const NodeGroup& group) {
  ContactFace face;
  const std::vector<Backing> behind = bodies_behind(mesh, group.facets);
  std::map<GlobalIndex, Vector3> sums;
  Vector3 total{0, 0, 0};
  for (std::size_t f = 0; f < group.facets.size(); ++f) {
    if (!behind[f].found) {
      continue;
    }
    const Facet& facet = group.facets[f];
    face.sided = face.sided && !behind[f].same_nodes;
    const Vector3 area = outward_area(mesh, facet, behind[f]);
    face.facets.push_back(facet);
    face.facet_normals.push_back(normalised(area));
    for (std::size_t d = 0; d < 3; ++d) {
      total[d] += area[d];
      for (const GlobalIndex node : facet.corners()) {
        sums[node][d] += area[d];
      }
    }
  }
  for (const auto& [node, sum] : sums) {
    face.nodes.push_back(node);
    Vector3 normal = normalised(sum);
    for (double& component : normal) {
      // Round-off of a face along an axis would couple components that have nothing to do with it.
      if (std::abs(component) < 1e-12) {
        component = 0;
      }
    }
    face.node_normals.push_back(normalised(normal));
  }
  face.mean_normal = normalised(total);
  if (!face.nodes.empty()) {
    face.centroid = centroid(mesh, face.nodes);
  }
  return face;
}

void turn_towards(ContactFace& face, const Vector3& point) {
  if (face.sided || dot(face.mean_normal, minus(point, face.centroid)) >= 0) {
    return;
  }
  const auto turn = [](Vector3& normal) { normal = {-normal[0], -normal[1], -normal[2]}; };
  std::for_each(face.node_normals.begin(), face.node_normals.end(), turn);
  std::for_each(face.facet_normals.begin(), face.facet_normals.end(), turn);
  turn(face.mean_normal);
}

std::optional<FacetPoint> meet_facet(const GlobalMesh& mesh, const Facet& facet,
                                     const Vector3& origin, const Vector3& direction,
                                     double tolerance, double reach) {
  if (facet.count == 2) {
    return meet_edge(mesh, facet, origin, direction, tolerance, reach);
  }
  // Newton on x(xi, eta) - origin - distance * direction = 0; exact in one step on a triangle.
  const bool triangle = facet.count == 3;
  double xi = triangle ? 1.0 / 3 : 0;
  double eta = xi;
  FacetPoint point;
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
    for (std::size_t a = 0; a < static_cast<std::size_t>(facet.count); ++a) {
      const Vector3 x = mesh.position(facet.nodes[a]);
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
    if (std::abs(determinant) < 1e-12 * std::sqrt(dot(normal, normal))) {
      return std::nullopt;
    }
    const double step_xi = -dot(cross(offset, tangent_eta), direction) / determinant;
    const double step_eta = -dot(cross(tangent_xi, offset), direction) / determinant;
    if (!(std::abs(step_xi) < 1e3) || !(std::abs(step_eta) < 1e3)) {
      return std::nullopt;
    }
    if (std::abs(step_xi) + std::abs(step_eta) < 1e-14) {
      break;
    }
    xi += step_xi;
    eta += step_eta;
  }
  const double outside =
      triangle ? std::max({-xi, -eta, xi + eta - 1}) : std::max(std::abs(xi), std::abs(eta)) - 1;
  if (outside > tolerance) {
    return std::nullopt;
  }
  return point;
}

}  // namespace pounding
