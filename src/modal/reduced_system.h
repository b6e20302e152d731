#pragma once

#include <span>
#include <string>

#include "modal/modal_analysis.h"
#include "modal/modal_basis.h"
#include "scene/scene.h"
#include "system/linear_system.h"

/// A structure in the coordinates q of a modal basis, u = Phi q:
///
///     q'' + C q' + diag(omega^2) q = -Phi^T M iota a_g(t) + Phi^T L^T r
///
/// with C = alpha I + beta diag(omega^2), or diag(2 xi omega) where damping ratios are given per
/// mode. All frequencies are known, so limits of the time step are exact and need no eigensolver.
namespace pounding {

/// The system; rank `owner` has all coordinates, the others none. The rows of the basis go into it.
/// Collective over `comm`.
LinearSystem build_reduced_system(MPI_Comm comm, int owner, const Structure& structure,
                                  ModalBasis& basis);

/// The lowest `count` modes of the basis, for the report.
ModalResult modes_of_basis(const ModalBasis& basis, int count);

/// The largest frequency of the basis, and which coordinate has it.
LargestFrequency largest_frequency(const ModalBasis& basis);

/// As `stable_time_step` and `energy_margin` of dynamics/stable_time_step.h, the smallest over all
/// coordinates.
double stable_time_step(const Structure& structure, const ModalBasis& basis);
double energy_margin(const Structure& structure, const ModalBasis& basis, double time_step);

/// "generalised coordinate 12 (34.5 Hz)", counted from 1.
std::string describe_coordinate(const ModalBasis& basis, std::size_t coordinate);

/// The coordinate of the largest |value| over all ranks (what is not a number counts as largest).
/// The same on all ranks. Collective.
std::string locate_largest(const LinearSystem& system, const ModalBasis& basis,
                           std::span<const double> values);

}  // namespace pounding
