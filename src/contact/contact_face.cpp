#include "contact/contact_face.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

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

/// For every facet the centroid of the solid element that holds all its nodes.
std::vector<Vector3> bodies_behind(const GlobalMesh& mesh, const std::vector<Facet>& facets) {
  std::map<std::vector<GlobalIndex>, std::size_t> wanted;
  std::set<GlobalIndex> face_nodes;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    std::vector<GlobalIndex> key(facets[f].corners().begin(), facets[f].corners().end());
    face_nodes.insert(key.begin(), key.end());
    std::sort(key.begin(), key.end());
    wanted[key] = f;
  }
  std::vector<Vector3> behind(facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f) {
    behind[f] = centroid(mesh, facets[f].corners());
  }
  for (const ElementSet& set : mesh.regions) {
    const auto width = static_cast<std::size_t>(element_layout(set.type).nodes);
    for (std::size_t e = 0; e < set.tags.size(); ++e) {
      const std::span<const GlobalIndex> nodes(&set.connectivity[e * width], width);
      std::vector<GlobalIndex> on_face;
      std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(on_face),
                   [&](GlobalIndex node) { return face_nodes.count(node) != 0; });
      if (on_face.size() < 3 || on_face.size() == width) {
        continue;
      }
      std::sort(on_face.begin(), on_face.end());
      const auto found = wanted.find(on_face);
      if (found != wanted.end()) {
        behind[found->second] = centroid(mesh, nodes);
      }
    }
  }
  return behind;
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
  std::copy_if(group.facets.begin(), group.facets.end(), std::back_inserter(face.facets),
               [](const Facet& facet) { return facet.count >= 3; });
  const std::vector<Vector3> behind = bodies_behind(mesh, face.facets);
  std::map<GlobalIndex, Vector3> sums;
  Vector3 total{0, 0, 0};
  for (std::size_t f = 0; f < face.facets.size(); ++f) {
    Vector3 area = area_vector(mesh, face.facets[f]);
    if (dot(area, minus(centroid(mesh, face.facets[f].corners()), behind[f])) < 0) {
      area = {-area[0], -area[1], -area[2]};
    }
    face.facet_normals.push_back(normalised(area));
    for (std::size_t d = 0; d < 3; ++d) {
      total[d] += area[d];
      for (const GlobalIndex node : face.facets[f].corners()) {
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
  return face;
}

std::optional<FacetPoint> meet_facet(const GlobalMesh& mesh, const Facet& facet,
                                     const Vector3& origin, const Vector3& direction,
                                     double tolerance) {
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
