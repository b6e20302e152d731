#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "scene/scene.h"
#include "stiffness/element_loop.h"

namespace pounding {

/// Squared radii of gyration that a flat shell is given beside its own [m2].
struct AddedRadii {
  double bending = 0;   ///< rotations about axes in its plane
  double drilling = 0;  ///< rotation about its normal; at least `bending`
};

/// Rotational inertia that shells were given for a longer time step.
struct RotaryScaling {
  GlobalIndex elements = 0;     ///< that were given some, over all ranks
  double bending = 0;           ///< largest ratio of added to own inertia, in bending [-]
  double drilling = 0;          ///< the same about the normal [-]
  std::vector<double> inertia;  ///< added per owned dof [kg m2]; empty: none asked for
};

/// The least radii with which a shell allows a time step dt by itself. With M_e' its mass after
/// that, a = 4 - 2 dt alpha, b = 2 dt beta + s dt^2 (s: `stiffening`), it asks for
///
///     a M_e' - b K_e >= 0
///
/// whose Schur complement in the rotations r, the displacements u eliminated, is
///
///     a J' >= b K_rr + b^2 K_ru (a M_uu - b K_uu)^-1 K_ur
///
/// J' gets m_a r^2 at each node of mass m_a: r^2 is the largest eigenvalue of the missing part, in
/// the plane and about the normal apart; the coupling of the two in a warped shell is added to both
/// by its norm. Nothing if the displacements alone allow no such step. `coordinates` (n, 3) [m],
/// `stiffness` (6 n, 6 n), `mass` (6 n).
std::optional<AddedRadii> needed_radii(double time_step, const Rayleigh& damping, double stiffening,
                                       std::span<const double> coordinates,
                                       std::span<const double> stiffness,
                                       std::span<const double> mass);

/// Adds m_a times the squared radii to the rotations in `mass`, shape (6 n) [kg, kg m2], of a flat
/// shell. About its normal n the inertia J n n^T is replaced by the diagonal matrix
/// J |n_i| (|n_1| + |n_2| + |n_3|), which is no smaller, and the same along an axis.
void add_radii(const AddedRadii& radii, std::span<const double> coordinates,
               std::span<double> mass);

/// Gives shells the rotational inertia that they need for the time step of their structure, element
/// by element from the element alone: the same on any number of ranks.
class AddedInertia {
 public:
  AddedInertia(const Structure& structure, const Mesh& mesh);

  /// Adds to the lumped mass of an element in `work` where it is a shell and the structure scales
  /// shells. False for a shell that no rotational inertia can bring there.
  bool add(const ElementBlock& block, std::size_t element, stiffness::ElementWork& work);
  /// Fills in the added inertia, over all ranks. Collective.
  void share(RotaryScaling& scaling);

 private:
  const Structure& structure_;
  const Mesh& mesh_;
  RotaryScaling scaling_;
};

/// The scaled mass that all elements of a structure need for a step, if it helps them.
struct StepPlan {
  bool feasible = false;        ///< every element allows the step, scaled or not, over all ranks
  std::vector<double> inertia;  ///< rotational, added per owned dof [kg m2]
  double largest_factor = 0;    ///< c of mass scaling (mass_scaling.h), over all ranks [s2]
};

/// Plans for `structure.mass_scaling`, nothing assembled. Collective.
StepPlan plan_step(const Structure& structure, const Mesh& mesh);

}  // namespace pounding
