#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <mpi.h>

#include "interactions/interaction.h"
#include "interactions/interface_rows.h"
#include "solvers/law_solver.h"
#include "system/linear_system.h"

namespace pounding::interactions {

/// Rows L over points of structures that push by laws of their own, with H = L M^-1 L^T: their
/// elongations L u and rates L v, and the impulses by which they push. Every rank that knows one of
/// their dofs holds and computes the same. Constant but for the values of the last gather; nothing
/// allocates after construction.
class CoupledRows {
 public:
  /// Dofs of `more` get columns as well. Collective over `comm`.
  CoupledRows(MPI_Comm comm, const std::vector<Constraint>& constraints,
              std::span<const LinearSystem> systems, std::span<const Mesh> meshes,
              std::span<const ConstraintTerm> more = {});

  static constexpr double sense = 1;  ///< in which `gather` takes L u

  const InterfaceRows& rows() const { return rows_; }

  /// Over the owned dofs of a structure; `supports`: motion of supports that carry it along, see
  /// Trace::apply.
  void set_displacement(std::size_t structure, const double* owned,
                        std::span<const double> supports) {
    rows_.set(structure, 0, fields, owned, supports);
  }
  void set_velocity(std::size_t structure, const double* owned, std::span<const double> supports) {
    rows_.set(structure, 1, fields, owned, supports);
  }
  /// L u [m, rad] and L v per row from these. Members only, collective over them.
  void gather(std::span<double> elongation, std::span<double> rate);

  /// H of each row with itself first, then with the others.
  const std::vector<std::vector<Coupling>>& couplings() const { return couplings_; }
  /// An upper bound of the largest eigenvalue [1/s2] of k^1/2 H_s k^1/2, H_s the part of H of one
  /// structure, for springs k [N/m] at the rows. The same on all ranks; not collective.
  double largest_eigenvalue(std::size_t structure, std::span<const double> stiffness) const;

  /// See Interaction::attach.
  void attach(std::span<SteppedStructure* const> structures);
  /// Takes u_n and v- of all structures, carried along by these motions of supports, and remembers
  /// the state that `push` corrects. Members only.
  void begin(const Step& step, std::span<const double> displacement,
             std::span<const double> velocity);
  /// Takes v+ of all structures, likewise.
  void take_velocities(const Step& step, std::span<const double> supports);
  /// Corrects all structures by impulses [N s] of the rows, along L^T. Members only.
  void push(const Step& step, std::span<const double> impulses);
  /// Work of these on a structure's supports, see InterfaceRows.
  double support_work(std::size_t structure, std::span<const double> velocity) {
    return rows_.support_work(structure, dof_impulse_, velocity);
  }

 private:
  static constexpr std::size_t fields = 2;  // displacement and velocity

  void find_couplings(std::size_t structures);

  InterfaceRows rows_;
  std::vector<std::vector<Coupling>> couplings_;
  /// Per structure and row, its part of H.
  std::vector<std::vector<std::vector<Coupling>>> parts_;
  std::vector<double> values_;                 ///< shape (2, dofs)
  std::vector<double> dof_impulse_;            ///< L^T lambda
  std::vector<Before> before_step_;            ///< per structure
  std::vector<std::vector<double>> velocity_;  ///< per structure, of the trace's dofs
};

}  // namespace pounding::interactions
