#include "mesh/force_places.h"

#include <algorithm>
#include <limits>
#include <set>

#include "common/error.h"
#include "common/facts.h"
#include "common/matrix3.h"

namespace pounding {
namespace {

/// An element of a set of the mesh.
struct ElementPlace {
  const ElementSet* set = nullptr;
  std::size_t element = 0;

  std::span<const GlobalIndex> nodes() const { return set->nodes_of(element); }
};

std::vector<ElementPlace> places_of(const GlobalMesh& mesh) {
  std::vector<ElementPlace> places;
  for (const ElementSet& set : mesh.regions) {
    for (std::size_t e = 0; e < set.tags.size(); ++e) places.push_back({&set, e});
  }
  return places;
}

/// The element of the group whose middle is nearest to a point.
ElementPlace nearest(const ForceItem& force, const GlobalMesh& mesh,
                     const std::vector<ElementPlace>& group, const Vector3& point) {
  // The part of the extent of the mesh that is allowed beyond the size of the element.
  const double far = force.kind == ForceKind::shells ? 0 : 0.05;
  double least = std::numeric_limits<double>::infinity();
  ElementPlace best;
  for (const ElementPlace& place : group) {
    const double away = distance(centroid(mesh, place.nodes()), point);
    if (!(away < least * (1 - 1e-9))) continue;
    least = away;
    best = place;
  }
  double size = 0;
  for (const GlobalIndex node : best.nodes()) {
    size = std::max(size, distance(mesh.position(node), centroid(mesh, best.nodes())));
  }
  refuse_if(least > size + far * bounding_box({&mesh, 1}).diagonal(),
            sentence("option -{}_at: the point {} is {} m away from the middle of the nearest "
                     "element of {}; give a point on one",
                     {force.name, place_text(point), least, force.group}));
  return best;
}

std::vector<ElementPlace> chosen_elements(const ForceItem& force, const GlobalMesh& mesh) {
  std::vector<ElementPlace> group;
  for (const ElementPlace& place : places_of(mesh)) {
    if (place.set->group == force.group) group.push_back(place);
  }
  if (force.points.empty()) {
    std::ranges::stable_sort(group, {},
                             [](const ElementPlace& p) { return p.set->tags[p.element]; });
    return group;
  }
  std::vector<ElementPlace> chosen;
  for (const Vector3& point : force.points) {
    const ElementPlace place = nearest(force, mesh, group, point);
    const bool again = std::ranges::any_of(chosen, [&](const ElementPlace& other) {
      return other.set == place.set && other.element == place.element;
    });
    if (!again) chosen.push_back(place);
  }
  return chosen;
}

/// Refuses a plane that no element of the group crosses.
[[noreturn]] void refuse_missed(const ForceItem& force, const GlobalMesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (const ElementPlace& place : places_of(mesh)) {
    if (place.set->group != force.group) continue;
    for (const GlobalIndex node : place.nodes()) {
      const double along = dot(force.normal, mesh.position(node));
      least = std::min(least, along);
      most = std::max(most, along);
    }
  }
  throw UserError(sentence(
      "option -{}_level: no element of {} crosses the level {}; along the normal the group "
      "reaches from {} to {} m, and nodes on the level count as below",
      {force.name, force.group, force.level, least, most}));
}

/// Elements of which a total counts some force but not all: their own sum is zero.
std::vector<ElementPlace> passing_elements(const ForceItem& force, const GlobalMesh& mesh) {
  std::vector<ElementPlace> passing;
  for (const ElementPlace& place : places_of(mesh)) {
    if (force.kind == ForceKind::cut && place.set->group != force.group) continue;
    const ElementTraits& traits = traits_of(place.set->type);
    if (traits.stiffness == nullptr || traits.family == ElementFamily::point_mass) continue;
    bool some = false;
    bool all = !is_grounded(place.set->type);
    for (const GlobalIndex node : place.nodes()) {
      for (int c = 0; c < traits.layout.components; ++c) {
        const bool one = counts(force, mesh.free_components[node], mesh.position(node), c);
        some = some || one;
        all = all && one;
      }
    }
    if (some && !all) passing.push_back(place);
  }
  if (passing.empty() && force.kind == ForceKind::cut) refuse_missed(force, mesh);
  return passing;
}

}  // namespace

bool counts(const ForceItem& force, std::uint8_t free_components, const Vector3& x, int component) {
  if (force.kind == ForceKind::cut) return force.beyond(x);
  if ((free_components >> component & 1) == 0) return false;
  return force.kind != ForceKind::storey || force.beyond(x);
}

namespace {

/// Refuses a storey above the whole structure, through which nothing passes.
void require_storey(const ForceItem& force, const GlobalMesh& mesh) {
  if (force.kind != ForceKind::storey) return;
  const BoundingBox box = bounding_box({&mesh, 1});
  refuse_if(!(force.level < box.high[2]),
            sentence("option -{}_level: no node of {} lies above {} m; it reaches from {} to {} m",
                     {force.name, force.structure, force.level, box.low[2], box.high[2]}));
}

}  // namespace

std::vector<ResolvedForce> resolve_forces(const Scene& scene, std::span<const GlobalMesh> meshes) {
  std::vector<ResolvedForce> forces;
  for (const ForceItem& force : scene.forces) {
    const std::size_t s = structure_number(scene, force.structure);
    ResolvedForce& resolved = forces.emplace_back();
    resolved.structure = static_cast<int>(s);
    require_storey(force, meshes[s]);
    std::vector<ElementPlace> places;
    if (force.of_elements()) {
      places = chosen_elements(force, meshes[s]);
    } else if (force.kind == ForceKind::cut || scene.structures[s].modal) {
      places = passing_elements(force, meshes[s]);
    }
    std::set<GlobalIndex> nodes;
    for (const ElementPlace& place : places) {
      resolved.elements.push_back(place.set->tags[place.element]);
      resolved.regions.push_back(place.set->region);
      nodes.insert(place.nodes().begin(), place.nodes().end());
    }
    resolved.nodes.assign(nodes.begin(), nodes.end());
  }
  return forces;
}

}  // namespace pounding
