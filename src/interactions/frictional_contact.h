#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "common/saved_state.h"
#include "interactions/contact_operator.h"
#include "interactions/delassus.h"
#include "interactions/pairing/interface.h"
#include "solvers/friction_solver.h"
#include "solvers/sparse_rows.h"

namespace pounding::interactions {

/// The constraints and, after them, two tangential rows for each one with friction.
std::vector<Constraint> with_friction_rows(std::span<const Constraint> constraints);

/// Coulomb's friction within a contact problem whose operator has the rows of with_friction_rows():
/// the components in which a constraint has friction, each solved as a whole. Every rank of the
/// interface holds the same and solves alike. A row is a constraint here, its tangents are extra.
class FrictionalContact {
 public:
  /// References must outlive this object.
  FrictionalContact(const ContactOperator& contact, const InterfaceCompliance& compliance,
                    std::span<const Constraint> constraints);

  bool has_friction(int row) const { return points_[row].tangent >= 0; }
  bool has_any() const { return has_any_; }
  /// The row of the operator for each tangent of a constraint with friction, at `row` and the next.
  int tangent(int row) const { return points_[row].tangent; }

  void forget_components() { components_.clear(); }
  /// Takes over rows that are coupled with each other and with nothing else, some with friction.
  /// Returns the number of the component.
  std::size_t add(std::vector<int> rows, DelassusPattern& pattern);
  /// Room for the arrays of solve(); after the last add().
  void reserve();

  /// Forgets the impulses, keeping them as the next guess.
  void clear();
  struct Solution {
    double residual = 0;   ///< friction_residual [-]
    double free_rate = 0;  ///< largest |b| [m/s]
  };
  /// Impulses and contact works of the active rows of a component: adds L^T lambda to
  /// `dof_impulse`, writes `impulse` and `work` of its active rows. `before`, `free`: velocities
  /// v-, v_free over the interface's dofs.
  Solution solve(std::size_t number, std::span<const char> active, std::span<const double> before,
                 std::span<const double> free, std::span<double> impulse, std::span<double> work,
                 std::span<double> dof_impulse);

  /// Results of the last solve, per row.
  const std::vector<Vector3>& tangential_impulses() const { return across_; }  ///< [N s]
  const std::vector<double>& slip_rates() const { return slip_; }  ///< |v_t+| in contact [m/s]
  const std::vector<double>& losses() const { return loss_; }      ///< -1/2 lambda_t (v_t- + v_t+)

  /// The tangential impulses of the last solve, from which the next one starts.
  void keep(const StateKeeper& state);
  /// The numbers that are kept, three per row.
  std::span<double> kept() { return {impulse_.data()->data(), 3 * impulse_.size()}; }

 private:
  struct Point {
    int tangent = -1;  ///< first of its two rows in the operator; -1: no friction
    double coefficient = 0;
    std::array<Vector3, 2> tangents{};  ///< directions of the two
  };
  struct Component {
    std::vector<int> rows;
    SparseRows delassus;  ///< three rows each, zeros for tangents without friction
  };
  /// Row of the operator for a direction of a constraint, normal 0; -1: none.
  int operator_row(int row, std::size_t direction) const;

  const ContactOperator& operator_;
  const InterfaceCompliance& compliance_;
  std::vector<Point> points_;  ///< per row
  bool has_any_ = false;
  std::vector<Component> components_;
  std::vector<int> index_;  ///< per row of the operator: its constraint's within its component
  std::optional<FrictionSolver> solver_;  ///< once there is room
  std::vector<std::size_t> indices_;      ///< active rows within the component
  std::vector<int> numbers_;              ///< of the active ones' directions; -1: not active
  SparseRows matrix_;                     ///< H of the active rows
  std::vector<double> rate_;
  std::vector<double> solution_;
  std::vector<double> coefficient_;
  std::vector<std::array<double, 3>> impulse_;   ///< per row
  std::vector<std::array<double, 3>> previous_;  ///< per row
  std::vector<Vector3> across_;
  std::vector<double> slip_;
  std::vector<double> loss_;
};

}  // namespace pounding::interactions
