#pragma once

#include <span>
#include <utility>
#include <vector>

#include "mesh/mesh.h"

namespace pounding {

/// Mass of a dof that has none of its own [kg, kg m2].
using LentMass = std::pair<LocalIndex, double>;

/// Masses for the owned dofs without one that follow a rigid body or a tie, as the end of a rigid
/// arm on a spring does. Such a dof has no motion of its own; a millionth of the mass that the body
/// has there, shared by all of these dofs, or 1e-7 of that of a carrier of the tie, lets it be
/// divided by and takes at most 5e-7 of any frequency; less would spoil the digits of values scaled
/// by M^-1/2. A dof of a rigid body gets none where the body has hardly a mass (less than 1e-4 of
/// its own), since nothing resists that motion. `lumped_mass` of all owned dofs. Local.
std::vector<LentMass> lend_mass(const Mesh& mesh, std::span<const double> lumped_mass);

}  // namespace pounding
