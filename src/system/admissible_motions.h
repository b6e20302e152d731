#pragma once

#include <vector>

#include "common/petsc.h"
#include "system/linear_system.h"

namespace pounding {

/// Motions u = T z that the rigid bodies of a structure admit, for what is solved with a matrix
/// rather than advanced step by step. T is square: z has a value for every dof, those of the first
/// dofs of a body are the coordinates of its motions (W of RigidBody), those of the others stand
/// idle and move nothing. So z is distributed as u is. The mass of a body's coordinates is 1.
class AdmissibleMotions {
 public:
  enum class Alone {
    as_is,       ///< T is 1 for dofs of no body
    mass_scaled  ///< M^-1/2, so that T^T M T = I
  };
  /// `system` must outlive this object and have rigid bodies. Collective.
  AdmissibleMotions(const LinearSystem& system, Alone alone);

  /// T^T A T, a new matrix, with `idle` on the diagonal of what stands idle; by default more than
  /// the largest diagonal entry, so that no idle value is among the lowest ones of a stiffness.
  /// Collective.
  MatHandle restrict_matrix(Mat matrix, double idle = 0) const;
  /// u = T z and z = T^T f, in place. Collective.
  void to_motion(std::vector<double>& z) const;
  void to_coordinates_of_force(std::vector<double>& f) const;
  /// z of a motion u = T z, in place. Local.
  void to_coordinates(std::vector<double>& u) const;

 private:
  void multiply(std::vector<double>& x, bool transposed) const;

  const LinearSystem& system_;
  Alone alone_;
  std::vector<char> is_idle_;  ///< per owned dof
  MatHandle matrix_;           ///< T
};

/// f := M W W^T f of forces on the rigid bodies of this rank, over all owned dofs: what is left of
/// them once the body has taken up what it can. Local.
void take_up_by_bodies(const LinearSystem& system, std::vector<double>& f);

}  // namespace pounding
