#pragma once

#include <span>
#include <vector>

#include "laws/element_law.h"
#include "mesh/mesh.h"
#include "system/linear_system.h"

/// Dofs, forces and first slopes of the elements that yield by a law.
namespace pounding {

/// Per owned dof of a mesh, whether one of the laws that are apart, or of the others, may act on
/// it; empty where there is none of them.
std::vector<char> dofs_of_laws(const std::vector<interactions::RegionLaw>& laws, bool apart,
                               const Mesh& mesh);

/// Adds the forces g over the owned dofs [N, N m] of a system's elements that are apart, or of the
/// others, whose history goes from nothing to these displacements of the owned dofs [m, rad] at
/// once; returns whether one of this rank yields. Collective likewise.
bool add_law_forces(const LinearSystem& system, bool apart, const Mesh& mesh,
                    const std::vector<double>& displacement, std::span<double> force);

/// Adds `sign` times the first slopes of the elements of which K holds nothing to a matrix over the
/// dofs. Collective likewise.
void add_law_stiffness(const LinearSystem& system, const Mesh& mesh, double sign, Mat matrix);

}  // namespace pounding
