#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <mpi.h>

#include "interactions/interface_rows.h"
#include "interactions/pairing/interface.h"
#include "interactions/solvers/law_solver.h"
#include "system/linear_system.h"

namespace pounding::interactions {

/// The pairs of contacts with fillers as rows of their own, L u of their gaps: how far each filler
/// is compressed, how fast, and the impulses by which it presses on the structures. Every rank that
/// knows one of their dofs holds and computes the same. Constant but for the values of the last
/// gather; nothing allocates after construction.
class FillerPairs {
 public:
  /// Collective over `comm`.
  FillerPairs(MPI_Comm comm, const Interface& interface, std::span<const LinearSystem> systems,
              std::span<const Mesh> meshes);

  struct Pair {
    int contact = 0;      ///< index into the scene's contacts
    std::size_t row = 0;  ///< among the constraints of the interface
    FillerPart part;      ///< its clearance that of the state at rest, where the run starts from it
    std::array<double, 2> place{};  ///< on the tangent axes of the contact [m]
  };
  const std::vector<Pair>& all() const { return pairs_; }
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
  /// Compression d [m] and its rate [m/s] per pair from these. Members only, collective over them.
  void gather(std::span<double> compression, std::span<double> rate);

  /// H of each pair with itself first, then with the others.
  const std::vector<std::vector<Coupling>>& couplings() const { return couplings_; }
  /// An upper bound of the largest eigenvalue [1/s2] of k^1/2 H_s k^1/2, H_s the part of H of one
  /// structure, for springs k [N/m] at the pairs. The same on all ranks; not collective.
  double largest_eigenvalue(std::size_t structure, std::span<const double> stiffness) const;

  /// Impulses [N s] of all pairs that push the sides apart.
  void set_impulses(std::span<const double> impulses);
  /// v += M^-1 T^T L^T of these over the dofs of the structure's trace.
  void add_velocity_change(std::size_t structure, double* velocity) {
    rows_.add_velocity_change(structure, dof_impulse_, velocity);
  }
  /// Their work on a structure's supports, see InterfaceRows.
  double support_work(std::size_t structure, std::span<const double> velocity) {
    return rows_.support_work(structure, dof_impulse_, velocity);
  }

 private:
  static constexpr std::size_t fields = 2;  // displacement and velocity

  void find_couplings(std::size_t structures);
  void count_from_rest(std::span<const LinearSystem> systems);

  std::vector<Pair> pairs_;
  InterfaceRows rows_;
  std::vector<std::vector<Coupling>> couplings_;
  /// Per structure and pair, its part of H.
  std::vector<std::vector<std::vector<Coupling>>> parts_;
  std::vector<double> values_;       ///< shape (2, dofs)
  std::vector<double> dof_impulse_;  ///< L^T lambda
};

}  // namespace pounding::interactions
