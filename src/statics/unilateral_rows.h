#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <mpi.h>

#include "interactions/interface_rows.h"
#include "interactions/structure_links.h"
#include "laws/link_law.h"
#include "solvers/law_solver.h"
#include "system/linear_system.h"
#include "system/links.h"

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
/// every row; displacements reach all of them by the gather of interactions (InterfaceRows).
class UnilateralRows {
 public:
  /// `open`: per contact point, whether it is open whatever the displacements are; one that faces
  /// nothing yet is open as well. Collective over `comm`.
  UnilateralRows(MPI_Comm comm, std::span<const interactions::Constraint> contacts,
                 std::span<const char> open, std::span<const LinearSystem> systems,
                 std::span<const Mesh> meshes);

  int size() const { return static_cast<int>(compliance_.size()); }
  int contacts() const { return contacts_; }  ///< rows of contact points, the first ones
  double compliance(int row) const { return compliance_[row]; }  ///< c [m/N]
  bool open(int row) const { return open_[row] != 0; }           ///< f is 0 and w means nothing
  /// w0 + R u of all rows [m]; `displacement` per structure over the owned dofs. Collective.
  std::vector<double> openings(std::span<const std::vector<double>> displacement);
  /// Changes R u of w, all rows [m]. Collective.
  std::vector<double> responses(std::span<const std::vector<double>> displacement);
  /// Adds f R^T of a row to forces per structure over the owned dofs. Local.
  void add_force(int row, double f, std::span<std::vector<double>> forces) const;

 private:
  /// Constraints of one structure's one-way links, those of rank 0 first; their slack is the
  /// initial gap.
  void add_links(std::size_t structure, const LinearSystem& system,
                 std::vector<interactions::Constraint>& constraints);
  /// Constraints of the contact points and of all links.
  std::vector<interactions::Constraint> all_constraints(
      std::span<const interactions::Constraint> contacts, std::span<const LinearSystem> systems);

  MPI_Comm comm_;
  int contacts_;
  std::vector<double> initial_;     ///< w0 [m]
  std::vector<double> compliance_;  ///< c [m/N]
  std::vector<char> open_;
  interactions::InterfaceRows rows_;
};

/// A link that holds a force at rest, over the owned dofs of its structure, or its generalised
/// coordinates: its elongation is sum of coefficient x dof.
struct LinkTerms {
  const Link* link = nullptr;
  double stiffness = 0;  ///< k, the largest tangent of its law [N/m]
  bool one_way = false;
  std::vector<LocalIndex> dofs{};
  std::vector<double> coefficients{};  ///< b, not zero [-]

  /// b . u of the owned dofs [m].
  double elongation(const std::vector<double>& u) const {
    double sum = 0;
    for (std::size_t k = 0; k < dofs.size(); ++k) sum += coefficients[k] * u[dofs[k]];
    return sum;
  }
};

/// Tension-only bars, compression-only springs and bearings that slide or yield on a circle of this
/// rank: links that hold a force at rest, which dashpots do not; or `all`. They borrow the system's
/// links. Local.
std::vector<LinkTerms> link_terms(const LinearSystem& system, bool all = false);

/// Bearings of this rank that slide or yield on a circle, at rest: their history goes from nothing
/// to the rest at once. It borrows the system's links. Local.
class RestLinks {
 public:
  explicit RestLinks(const LinearSystem& system);

  /// Adds their forces at displacements of the owned dofs [m, rad], less those of their first
  /// slopes, to `force` [N, N m]; returns whether any differs from that.
  bool add_forces(const std::vector<double>& displacement, std::span<double> force) const;

  /// A spring that has yielded on a circle, or slides, at a rest.
  struct Slid {
    const Link* link = nullptr;
    double force = 0;  ///< [N]
  };
  /// The first of them at displacements of the owned dofs.
  std::optional<Slid> slid(const std::vector<double>& displacement) const;

 private:
  /// Elongations of all links, and their memories once the law of a step from there has yielded.
  struct Rest {
    std::vector<double> now;
    interactions::LawMemory memory;
  };
  Rest rest_at(const std::vector<double>& displacement) const;

  std::vector<LinkTerms> terms_;                              ///< of all links
  std::vector<std::unique_ptr<interactions::LinkLaw>> laws_;  ///< per term
  std::optional<interactions::YieldGroups> groups_;
};

}  // namespace pounding
