#pragma once

#include <cmath>
#include <span>
#include <string>

#include "mesh/mesh.h"
#include "modal/lanczos.h"
#include "modal/shifted_solver.h"
#include "scene/scene.h"
#include "system/linear_system.h"

namespace pounding {

/// How far the frequencies of a structure up to omega can fall through scaled mass dM >= 0. If
///
///     dM <= e (M + K / omega^2) + c K
///
/// for every motion, then by the minimax theorem every eigenvalue, in its order, is
///
///     lambda' >= lambda / (1 + e (1 + lambda / omega^2) + c lambda)
///
/// so that no frequency up to omega falls by more than 1 - (1 + 2 e + c omega^2)^-1/2 of itself,
/// whatever the shape of the elements, their joints and supports. None rises.
struct FrequencyChange {
  double rotations = 0;  ///< e, of the rotational inertia of shells [-]
  double elements = 0;   ///< c omega^2, c the largest factor of mass scaling [-]
  /// The bound, and that with one kind of scaled mass alone [-].
  double largest() const { return 1 - 1 / std::sqrt(1 + 2 * rotations + elements); }
  double by_rotations() const { return FrequencyChange{rotations, 0}.largest(); }
  double by_elements() const { return FrequencyChange{0, elements}.largest(); }
};

/// e of added inertia D: the largest eigenvalue of D^1/2 (M + K / omega^2)^-1 D^1/2 by Lanczos
/// (MUMPS), which comes from below, plus the tenth by which it can be too small but for a
/// probability of 1e-9 (modal/lanczos.h).
class RotationBound {
 public:
  /// Factorises. `omega` [rad/s]. Needs the matrix of the system, which has no scaled mass and must
  /// outlive it, as the mesh must. Collective.
  RotationBound(const LinearSystem& system, const Mesh& mesh, double omega);

  struct Found {
    double part = 0;       ///< e [-]
    std::string location;  ///< where the motion with the largest e turns most
  };
  /// The part e of an inertia D per owned dof [kg m2]. Collective.
  Found bound(std::span<const double> inertia) const;

 private:
  const LinearSystem& system_;
  const Mesh& mesh_;
  MatHandle matrix_;  ///< M + K / omega^2
  ShiftedSolver solver_;
};

/// Uniform damping with the ratio that Rayleigh damping has at the first frequency [Hz]; nothing
/// without damping of the stiffness.
std::optional<UniformDamping> uniform_in_place_of(const Rayleigh& damping, double first);

/// A structure with as little scaled mass as the target of its time step takes.
struct StepDesign {
  Structure structure;     ///< scaled for a step a little shorter than the target, or not at all
  double before = 0;       ///< stable step without scaled mass [s]
  double after = 0;        ///< stable step with it [s]
  FrequencyChange change;  ///< its cost
};

/// Scales single elements for the shortest step, within half a per cent of the target, for which
/// the whole structure allows the target. Throws UserError that names the cause of the step, or the
/// frequencies that could fall by more than the target allows, and the step within reach.
/// Collective.
StepDesign design_for_target(const Structure& structure, const Mesh& mesh, StiffnessMethod method,
                             const EigenvalueEffort& effort);

}  // namespace pounding
