#pragma once

#include <span>
#include <vector>

#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding::interactions {

/// Which facets of shells have their nodes in an order that is to be reversed, so that facets with
/// a common edge are all seen from the same side; the first one of a connected set keeps its own.
/// Only edges that two of the facets share connect them. A number other than 0 per facet to
/// reverse; facets with 0 in `shells` take no part.
std::vector<char> reversed_shells(std::span<const Facet> facets, std::span<const char> shells);

/// A solid, shell or beam that holds all nodes of a facet, and the facet as its border.
struct Backing {
  int region = 0;          ///< of the element, in its structure
  bool solid = false;      ///< it is no shell
  bool beam = false;       ///< the facet is its axis, whose normal is open: `area` is zero
  Vector3 area{0, 0, 0};   ///< area (of an edge: length) along the normal away from the element
  double depth = 0;        ///< how far the element reaches behind the facet, of a face of shells
                           ///< their thickness [m]
  bool two_sided = false;  ///< the facet is a whole shell: both of its sides are outside, `area`
                           ///< is as its nodes go round
};

/// A shell that holds all nodes of a facet.
struct ShellThere {
  Vector3 normal{0, 0, 0};  ///< unit
  double thickness = 0;     ///< [m]
};

/// All elements that hold all nodes of a facet; a beam only where it is the only one.
struct FacetBacking {
  std::vector<Backing> elements;  ///< shells whose whole is the facet only where no solid holds it
  std::vector<ShellThere> shells;

  /// Chooses of `elements` those that may lie behind a contact face: nothing else that holds the
  /// facet lies ahead of them, as the walls above and below a floor lie ahead of each other; of
  /// several along one direction the first. All of them if there is something ahead of each.
  std::vector<std::size_t> outer() const;
  /// There is something ahead of every element: the facet lies inside its structure.
  bool is_inner() const;
  /// How far shells reach beyond the facet along a unit vector: half of the thickness of one that
  /// lies across it, nothing of one that lies along it [m].
  double half_thickness(const Vector3& direction) const;
};

/// The elements behind every facet. `regions` of the structure of the mesh.
std::vector<FacetBacking> elements_behind(const GlobalMesh& mesh, std::span<const Region> regions,
                                          const std::vector<Facet>& facets);

}  // namespace pounding::interactions
