#pragma once

#include <memory>
#include <vector>

#include "common/matrix3.h"
#include "laws/element_law.h"
#include "mesh/mesh.h"
#include "scene/scene.h"

namespace pounding {

/// A motion of the nodes of a beam whose section yields, and the law that it follows in place of
/// its part of K.
struct SectionMotion {
  std::vector<double> shape;  ///< of 12 numbers: its elongation is shape . u of both nodes [m, rad]
  double stiffness = 0;       ///< of K [N/m, N m]
  Hysteresis law;
};

/// Motions of a beam of a region between two places, in the order of YieldingSection::names.
/// Throws std::domain_error as in_series does.
std::vector<SectionMotion> section_motions(const Region& region, const Vector3& first,
                                           const Vector3& second);

/// Law in one dimension that a motion with the stiffness `elastic` [N/m] follows in series with
/// `law`, whose elongations are those of its own part. Throws std::domain_error where the sum of
/// both elongations would go back.
Hysteresis in_series(const Hysteresis& law, double elastic);

/// Laws of the regions of a structure that are marked inelastic: beams whose sections yield, shells
/// that yield in shear or crack. Throws UserError on every rank where an element cannot follow
/// them. Collective over the mesh's communicator.
std::vector<interactions::RegionLaw> inelastic_laws(const Structure& structure, const Mesh& mesh);

/// Per owned dof, whether one of them may act on it; empty where no rank has any.
std::vector<char> dofs_of_laws(const std::vector<interactions::RegionLaw>& laws, const Mesh& mesh);

/// Forces g beside K u over the owned dofs [N, N m] of elements whose history goes from nothing to
/// these displacements of the owned dofs [m, rad] at once. Collective likewise.
std::vector<double> forces_of_laws(const std::vector<interactions::RegionLaw>& laws,
                                   const Mesh& mesh, const std::vector<double>& displacement);

}  // namespace pounding
