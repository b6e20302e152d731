#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "system/linear_system.h"

namespace pounding {

/// How displacements at some places of a structure follow from the dofs of this rank, whatever the
/// structure's fidelity: u = T x, and M^-1 T^T f for forces f at the places. Of a finite-element
/// model a place is a dof of its own; of a body in generalised coordinates it is a row of
/// coefficients of all of them. Rows lie one after the other, so that a product reads memory once.
///
/// The places known to a rank are those whose node it owns. Local; nothing allocates after
/// construction.
class Trace {
 public:
  /// A clamped component is a place that never moves. Throws std::logic_error if a body in
  /// generalised coordinates was made without one of the places.
  Trace(const LinearSystem& system, const Mesh& mesh, std::span<const TracePoint> places);

  /// Which of the places are known to this rank, as indices into the list given, increasing.
  const std::vector<int>& known() const { return known_; }
  /// Owned dofs that move the known places.
  const std::vector<LocalIndex>& dofs() const { return dofs_; }

  /// x = values of dofs() out of those of all owned dofs.
  void restrict_to_dofs(const double* owned, double* x) const;
  /// out[stride * k] = (T x)_k for each known place k, x over dofs().
  void apply(const double* x, double* out, std::size_t stride) const;
  /// x += M^-1 T^T f, f per known place, x over dofs().
  void add_impulse(const double* f, double* x);
  /// The part of (T M^-1 T^T) of two known places [1/kg].
  double compliance(std::size_t a, std::size_t b) const;
  /// Places share dofs: an impulse at one moves all of them.
  bool is_coupled() const { return coupled_; }

 private:
  void take_unit_rows(const Mesh& mesh, std::span<const TracePoint> places);
  void take_dense_rows(const LinearSystem& system, const Mesh& mesh,
                       std::span<const TracePoint> places);

  bool coupled_ = false;
  std::vector<int> known_;
  std::vector<LocalIndex> dofs_;
  std::vector<double> inverse_mass_;  ///< per dof of dofs_
  std::vector<int> own_dof_;   ///< unit rows: per known place into dofs_, -1 if it is clamped
  std::vector<double> rows_;   ///< else shape (known, dofs)
  std::vector<double> force_;  ///< T^T f
};

}  // namespace pounding
