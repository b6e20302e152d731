#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "system/linear_system.h"

namespace pounding {

/// How displacements at some points of a structure follow from the dofs of this rank, whatever the
/// structure's fidelity: u = T x, and M^-1 T^T f (M + S where S couples mass) for forces f at the
/// points. Of a finite-element
/// model a point is a dof of its own; of a body in generalised coordinates it is a row of
/// coefficients of all of them. Rows lie one after the other, so that a product reads memory once.
///
/// The points known to a rank are those whose node it owns. Local; nothing allocates after
/// construction.
class Trace {
 public:
  /// A clamped component is a point that never moves. Throws std::logic_error if a body in
  /// generalised coordinates was made without one of the points.
  /// With `impulses`, forces at the points may be applied, and dofs() are all that these move; else
  /// only `apply` may be called.
  Trace(const LinearSystem& system, const Mesh& mesh, std::span<const TracePoint> points,
        bool impulses);

  /// Which of the points are known to this rank, as indices into the list given, increasing.
  const std::vector<int>& known() const { return known_; }
  /// Owned dofs that move the known points, and those that move with them.
  const std::vector<LocalIndex>& dofs() const { return dofs_; }

  /// x = values of dofs() out of those of all owned dofs.
  void restrict_to_dofs(const double* owned, double* x) const;
  /// out[stride * k] = (T x)_k for each known point k, x over all owned dofs. `supports`: motion of
  /// the supports, per column of SupportShapes, which carries the points along; may be empty.
  void apply(const double* owned, double* out, std::size_t stride,
             std::span<const double> supports = {}) const;
  /// out[stride * k] += the way of known point k that a motion of the supports carries it.
  void carry(std::span<const double> supports, double* out, std::size_t stride) const;
  /// How far each column of the supports' motion carries known point k; empty where none does.
  std::span<const double> carried(std::size_t k) const {
    return {carried_.data() + k * columns_, columns_};
  }
  /// Work [J] of forces times their duration f [N s] at the known points on a velocity of the
  /// supports, per column.
  double support_work(std::span<const double> f, std::span<const double> velocity) const;
  /// x += M^-1 T^T f, f per known point, x over dofs().
  void add_impulse(const double* f, double* x);
  /// Row k of T of a structure in generalised coordinates, over all of them.
  std::span<const double> row(std::size_t k) const {
    return {rows_.data() + k * dofs_.size(), dofs_.size()};
  }
  /// The owned dof that is known point k of a mesh; -1 if it is clamped.
  LocalIndex dof(std::size_t k) const { return own_dof_[k] < 0 ? -1 : dofs_[own_dof_[k]]; }
  /// owned += f (row k of T)^T, over all owned dofs.
  void add_force(std::size_t k, double f, std::span<double> owned) const;
  /// The part of (T M^-1 T^T) of two known points [1/kg].
  double compliance(std::size_t a, std::size_t b);
  /// Whether an impulse at a known point may move others of this rank.
  bool moves_others(std::size_t k) const {
    return dense_ ||
           (coupled_mass_ != nullptr && own_dof_[k] >= 0 && field_slot_[own_dof_[k]] >= 0);
  }

 private:
  void take_unit_rows(const Mesh& mesh, std::span<const TracePoint> points);
  /// Dofs whose mass is coupled to that of a known point.
  void take_coupled_dofs(const CoupledMass& mass);
  void take_dense_rows(const LinearSystem& system, const Mesh& mesh,
                       std::span<const TracePoint> points);

  void take_supports(const LinearSystem& system, const Mesh& mesh,
                     std::span<const TracePoint> points);

  /// x += M^-1 force_.
  void add_solution(double* x);

  bool dense_ = false;
  const CoupledMass* coupled_mass_ = nullptr;  ///< null: force_ meets a diagonal mass only
  CoupledMass::Parts coupled_parts_;           ///< that known points are in
  std::vector<int> known_;
  std::vector<LocalIndex> dofs_;
  std::vector<double> inverse_mass_;  ///< per dof of dofs_
  std::vector<int> own_dof_;        ///< unit rows: per known point into dofs_, -1 if it is clamped
  std::vector<double> rows_;        ///< else shape (known, dofs)
  std::size_t columns_ = 0;         ///< of the supports' motion; 0: the ground moves as one
  std::vector<double> carried_;     ///< shape (known, columns)
  std::vector<double> force_;       ///< T^T f
  std::vector<int> field_slot_;     ///< per dof of dofs_, in field_; -1: its mass is not coupled
  std::vector<double> field_;       ///< see CoupledMass
  std::vector<double> response_;    ///< M^-1 T^T of a unit force at one point
  std::size_t response_point_ = 0;  ///< which one
};

/// The places of some owned dofs, increasing numbers.
std::vector<TracePoint> points_of(const Mesh& mesh, const std::vector<LocalIndex>& dofs);

}  // namespace pounding
