#pragma once

#include <vector>

#include "common/petsc.h"
#include "system/linear_system.h"

namespace pounding {

/// Motions u = T z that the rigid bodies and ties of a structure admit, for problems solved with a
/// matrix rather than advanced step by step. T is square: z has a value for every dof, those of the
/// first dofs of a body are the coordinates of its motions (W of RigidBody), those of the others,
/// and of the followers in a tie, are idle and move nothing. So z is distributed as u is. The mass
/// of a body's coordinates is 1.
class AdmissibleMotions {
 public:
  enum class Alone {
    as_is,  ///< T is 1 for dofs of no body, and B of a tie (see TiedPart)
    /// M^-1/2, and B G^-T of a tie: T^T M T = I, with full blocks for the carriers of a tie.
    mass_scaled
  };
  /// `system` must outlive this object and have rigid bodies or ties. Collective.
  AdmissibleMotions(const LinearSystem& system, Alone alone);

  /// T^T A T, a new matrix, with `idle` on the diagonal of idle values; by default more than the
  /// largest diagonal entry, so that no idle value is among the lowest ones of a stiffness.
  /// Collective.
  MatHandle restrict_matrix(Mat matrix, double idle = 0) const;
  /// u = T z and z = T^T f, in place. Collective.
  void to_motion(std::vector<double>& z) const { multiply(z, false); }
  void to_coordinates_of_force(std::vector<double>& f) const { multiply(f, true); }
  /// z of a motion u = T z, in place. Local.
  void to_coordinates(std::vector<double>& u) const;

 private:
  /// An entry of T, by owned dofs.
  struct Entry {
    LocalIndex row = 0;
    LocalIndex column = 0;
    double value = 0;
  };
  /// T of all ties; marks the followers as idle, and the dofs of both in `coupled`.
  std::vector<Entry> tie_entries(std::vector<char>& coupled);
  void multiply(std::vector<double>& x, bool transposed) const;

  const LinearSystem& system_;
  Alone alone_;
  std::vector<char> is_idle_;  ///< per owned dof
  MatHandle matrix_;           ///< T
};

/// f := M W W^T f of forces on the rigid bodies of a rank, M B (B^T M B)^-1 B^T f of those on its
/// ties, over all owned dofs: the rest of them once the constraints have taken up all that they
/// can. Local.
void take_up_by_constraints(const LinearSystem& system, std::vector<double>& f);

/// Sum of the forces f that nodes of this rank hand on to clamped components by ties [N]: the rest
/// of those on the followers once B^T has brought them to the carriers. Local.
Vector3 handed_to_clamps(const LinearSystem& system, const std::vector<double>& f);

}  // namespace pounding
