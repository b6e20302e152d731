#pragma once

#include <span>
#include <string>

#include "modal/modal_analysis.h"
#include "modal/modal_basis.h"
#include "scene/scene.h"
#include "system/linear_system.h"

/// A structure in the coordinates q of a modal basis, u = Phi q:
///
///     m q'' + C q' + diag(omega^2) q = -Phi^T M iota a_g(t) + Phi^T L^T r
///
/// with C = alpha m + beta diag(omega^2), or diag(2 xi omega) where damping ratios are given per
/// mode, and m = I unless mass is scaled. All frequencies are known, so limits of the time step are
/// exact and need no eigensolver.
namespace pounding {

/// The system; rank `owner` has all coordinates, and the whole mesh for its links, the others none.
/// The rows of the basis go into it. `columns`: motions of the scene's supports. Collective over
/// `comm`.
LinearSystem build_reduced_system(MPI_Comm comm, int owner, const Structure& structure,
                                  const Mesh& mesh, ModalBasis& basis,
                                  std::span<const SupportColumn> columns = {});

/// K times a factor: the vectors stay, their squared frequencies follow.
void scale_stiffness(double factor, ModalBasis& basis);

/// The lowest `count` modes of the basis, for the report.
ModalResult modes_of_basis(const ModalBasis& basis, int count);

/// m of each coordinate: 1, or the mass that brings its own limit to the step dt that scaled mass
/// asks for (`Structure::mass_scaling`), damping included:
///
///     m (4 - 2 dt alpha) = 2 dt beta omega^2 + dt^2 s omega^2
///
/// with s the stiffening of uniform damping, 1 without.
/// Static responses do not change; a coordinate that is slow against 2 / dt keeps its mass. Throws
/// UserError where alpha alone forbids dt.
std::vector<double> coordinate_masses(const Structure& structure, const ModalBasis& basis);

/// The largest frequency, mass scaled, and which coordinate has it.
LargestFrequency largest_frequency(const Structure& structure, const ModalBasis& basis);

/// Limits as in stability/stable_time_step.h, `stable_time_step` and `energy_margin`, smallest over
/// all coordinates.
double stable_time_step(const Structure& structure, const ModalBasis& basis);
double energy_margin(const Structure& structure, const ModalBasis& basis, double time_step);

/// "generalised coordinate 12 (34.5 Hz)", counted from 1.
std::string describe_coordinate(const ModalBasis& basis, std::size_t coordinate);

/// The coordinate of the largest |value| over all ranks (a value that is not a number counts as
/// largest). The same on all ranks. Collective.
std::string locate_largest(const LinearSystem& system, const ModalBasis& basis,
                           std::span<const double> values);

}  // namespace pounding
