#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <mpi.h>

#include "interactions/contact_problem.h"
#include "system/linear_system.h"

namespace pounding {

/// Unilateral conditions of a scene at rest, a row each: contact points first, in the order of the
/// interface, then tension-only bars and compression-only springs. With forces f >= 0 [N] of the
/// rows on the dofs,
///
///     0 <= f _|_ w >= 0,      w = w0 + R u + c f
///
/// where w is the gap of a contact point (w0 its initial gap, but 0 where bodies overlap, which
/// contact holds and does not push apart; R its row of L, c = 0) and, for a
/// link with the force f and the elongation e (of a spring: how far it is pressed), w = f / k - e,
/// that is w0 = 0, R = -b, c = 1 / k. The force on the dofs is R^T f of both. Every rank knows
/// every row and, of its dofs, those that it owns.
class UnilateralRows {
 public:
  /// `contact` may be null. `open`: per contact point, whether it is open whatever the
  /// displacements are. Collective over `comm`.
  UnilateralRows(MPI_Comm comm, const interactions::ContactProblem* contact,
                 std::span<const double> gaps, std::span<const char> open,
                 std::span<const LinearSystem> systems);

  int size() const { return static_cast<int>(rows_.size()); }
  int contacts() const { return contacts_; }  ///< rows of contact points, the first ones
  double compliance(int row) const { return rows_[row].compliance; }  ///< c [m/N]
  bool open(int row) const { return rows_[row].open; }  ///< f is 0 and w means nothing
  /// w0 + R u of all rows [m]; `displacement` per structure over the owned dofs. Collective.
  std::vector<double> openings(std::span<const std::vector<double>> displacement) const;
  /// Changes R u of w, all rows [m]. Collective.
  std::vector<double> responses(std::span<const std::vector<double>> displacement) const;
  /// Adds f R^T of a row to forces per structure over the owned dofs. Local.
  void add_force(int row, double f, std::span<std::vector<double>> forces) const;

 private:
  /// Part of one owned dof in w.
  struct Entry {
    std::size_t structure = 0;
    LocalIndex dof = 0;
    double coefficient = 0;
  };
  struct Row {
    double initial = 0;     ///< w0 [m]
    double compliance = 0;  ///< c [m/N]
    bool open = false;
    std::vector<Entry> entries;
  };
  void add_contacts(const interactions::ContactProblem& contact, std::span<const double> gaps,
                    std::span<const char> open, std::span<const LinearSystem> systems);
  /// Links of one structure, those of rank 0 first.
  void add_links(std::size_t structure, const LinearSystem& system);

  MPI_Comm comm_;
  int contacts_ = 0;
  std::vector<Row> rows_;
};

}  // namespace pounding
