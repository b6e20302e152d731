#include "interactions/pairing/crossing.h"

#include <cmath>

namespace pounding::interactions {
namespace {

/// Sine of an angle below which edges run alongside.
constexpr double alongside = 0.1;

/// A place this close to an end is the end, and this far beyond it still on the edge.
constexpr double corner = 1e-6;

/// Snaps a place to the ends of its edge; nothing beyond them.
std::optional<double> onto_edge(double place) {
  if (place < -corner || place > 1 + corner) return std::nullopt;
  if (place < corner) return 0;
  return place > 1 - corner ? 1 : place;
}

}  // namespace

std::optional<Crossing> cross_edges(const GlobalMesh& first_mesh, const Facet& first,
                                    const GlobalMesh& second_mesh, const Facet& second,
                                    const Vector3& direction) {
  const Vector3 a = minus(first_mesh.position(first.nodes[1]), first_mesh.position(first.nodes[0]));
  const Vector3 b =
      minus(second_mesh.position(second.nodes[1]), second_mesh.position(second.nodes[0]));
  const Vector3 to =
      minus(second_mesh.position(second.nodes[0]), first_mesh.position(first.nodes[0]));
  // s a - t b = to across the direction.
  const double area = dot(cross(a, b), direction);
  if (std::abs(area) < alongside * std::sqrt(dot(a, a) * dot(b, b))) return std::nullopt;
  const std::optional<double> s = onto_edge(dot(cross(to, b), direction) / area);
  const std::optional<double> t = onto_edge(dot(cross(to, a), direction) / area);
  if (!s || !t) return std::nullopt;
  return Crossing{*s, *t, dot(to, direction) + *t * dot(b, direction) - *s * dot(a, direction)};
}

}  // namespace pounding::interactions
