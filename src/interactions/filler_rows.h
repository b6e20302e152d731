#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <mpi.h>

#include "interactions/contact_operator.h"
#include "interactions/interface_compliance.h"
#include "interactions/interface_gather.h"
#include "interactions/pairing/interface.h"
#include "system/linear_system.h"
#include "system/trace.h"

namespace pounding::interactions {

/// The pairs of contacts with fillers as rows of their own, L u of their gaps: how far each filler
/// is compressed, how fast, and what presses on the structures. Every rank that knows one of their
/// dofs holds and computes the same. Constant but for the values of the last gather; nothing
/// allocates after construction.
class FillerRows {
 public:
  /// Collective over `comm`.
  FillerRows(MPI_Comm comm, const Interface& interface, std::span<const LinearSystem> systems,
             std::span<const Mesh> meshes);

  struct Row {
    int contact = 0;  ///< index into the scene's contacts
    FillerPart part;  ///< its clearance that of the state at rest, where the run starts from it
  };
  const std::vector<Row>& rows() const { return rows_; }
  bool member() const { return gather_.member(); }  ///< this rank knows a dof of some row
  int root() const { return gather_.root(); }       ///< the lowest member

  /// Motion of supports that carry the structures along, see Trace::apply; empty without.
  struct Supports {
    std::span<const double> displacement{};
    std::span<const double> velocity{};
  };
  /// Displacement and velocity over the owned dofs of a structure.
  void set_state(std::size_t structure, const double* displacement, const double* velocity,
                 const Supports& supports);
  /// Compression d [m] and its rate [m/s] per row from these. Members only, collective over them.
  void gather(std::span<double> compression, std::span<double> rate);

  /// Another row that impulses of a row move.
  struct Coupling {
    std::size_t row = 0;
    double compliance = 0;  ///< H of the two [1/kg]
  };
  /// H of each row with itself first, then with the others.
  const std::vector<std::vector<Coupling>>& couplings() const { return couplings_; }
  /// An upper bound of the largest eigenvalue [1/s2] of k^1/2 H_s k^1/2, H_s the part of H of one
  /// structure, for springs k [N/m] at the rows. The same on all ranks; not collective.
  double largest_eigenvalue(std::size_t structure, std::span<const double> stiffness) const;

  const Trace& trace(std::size_t structure) const { return traces_[structure]; }
  /// Impulses [N s] of all rows that push the sides apart, for add_velocity_change.
  void set_impulses(std::span<const double> impulses);
  /// v += M^-1 T^T L^T lambda over the dofs of the structure's trace.
  void add_velocity_change(std::size_t structure, double* velocity);
  /// Work of the impulses on a structure's supports that move with `velocity` [J]: that of the
  /// places that this rank knows.
  double support_work(std::size_t structure, std::span<const double> velocity);

 private:
  /// L^T lambda at the known places of a structure.
  void pick_impulses(std::size_t structure);
  void find_couplings(std::size_t structures);
  void count_from_rest(std::span<const LinearSystem> systems);

  std::vector<Row> rows_;
  ContactOperator operator_;
  std::vector<std::vector<int>> structure_dofs_;  ///< per structure: its dofs of the operator
  std::vector<Trace> traces_;
  std::vector<std::size_t> first_known_;  ///< per structure, into the values of this rank
  InterfaceGather gather_;
  InterfaceCompliance compliance_;
  std::vector<std::vector<Coupling>> couplings_;
  /// Per structure and row, its part of H.
  std::vector<std::vector<std::vector<Coupling>>> parts_;
  std::vector<double> mine_;         ///< shape (known, 2)
  std::vector<double> values_;       ///< shape (2, dofs)
  std::vector<double> dof_impulse_;  ///< L^T lambda
  std::vector<double> place_impulse_;
};

}  // namespace pounding::interactions
