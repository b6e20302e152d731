#pragma once

#include <memory>
#include <span>
#include <vector>

#include "common/saved_state.h"
#include "contact/contact_operator.h"
#include "contact/interface.h"
#include "contact/interface_gather.h"
#include "contact/lcp.h"
#include "system/linear_system.h"

namespace pounding {

/// The unilateral contact problem of one step, gathered at the ranks that own the interface and
/// solved there by each of them alike:
///
///     A = { i : g_i(u_n) <= g_tol },     0 <= lambda _|_ H lambda + L v_free >= 0   on A
///
/// H = L M^-1 L^T [1/kg] is built once. Rows that share no dof with another row are solved in
/// closed form, lambda_i = max(0, -(L v_free)_i / H_ii); coupled rows by the LCP solver, component
/// by component. Nothing allocates after construction.
class ContactProblem {
 public:
  /// Collective over `comm`. `gap_tolerance` [m].
  ContactProblem(MPI_Comm comm, const Interface& interface, std::span<const LinearSystem> systems,
                 std::span<const Mesh> meshes, double gap_tolerance);

  bool member() const { return gather_.member(); }
  int root() const { return gather_.root(); }
  int members() const { return gather_.members(); }
  int rows() const { return operator_.rows(); }
  int coupled_rows() const { return coupled_rows_; }

  /// Interface dofs of this rank, in the order of the numbers below.
  const std::vector<InterfaceGather::Owned>& owned() const { return gather_.owned(); }
  /// u_n and v_{n-1/2}, then v_free, of owned interface dof number i.
  void set_before(std::size_t i, double displacement, double velocity) {
    mine_[3 * i] = displacement;
    mine_[3 * i + 1] = velocity;
  }
  void set_free_velocity(std::size_t i, double velocity) { mine_[3 * i + 2] = velocity; }
  /// Gathers what was set and computes the gaps. Members only, collective over them.
  void gather();
  /// Active set; true if it is not empty.
  bool detect_contact();
  /// Impulses of the active rows, 0 elsewhere.
  void solve_impulse();
  /// v_free + M^-1 L^T lambda of owned interface dof number i.
  double corrected_velocity(std::size_t i, double free_velocity) const;

  /// Of the last gather, per row. Members only.
  const std::vector<double>& gaps() const { return gap_; }          ///< [m]
  const std::vector<double>& impulses() const { return impulse_; }  ///< [N s]
  const std::vector<double>& works() const { return work_; }        ///< 1/2 lambda L v- [J]
  double smallest_gap() const { return smallest_gap_; }
  /// Contact work 1/2 lambda^T L v- of the last solve [J].
  double total_work() const;
  double largest_residual() const { return largest_residual_; }
  /// Largest sqrt(L M^-1 L^T) over the rows with only one structure's columns: bounds the gap rate
  /// by that structure's kinetic energy [kg^-1/2].
  double rate_norm(int structure) const { return rate_norm_[static_cast<std::size_t>(structure)]; }
  double gap_tolerance() const { return gap_tolerance_; }

  /// The impulses of the last solve, from which the LCP starts, and the largest residual.
  void save(SavedState& saved) const;
  void load(const SavedState& saved);

 private:
  void build_delassus(std::span<const LinearSystem> systems);
  double delassus_entry(int row, int column) const;
  void find_components();
  void solve_component(const std::vector<int>& component);
  /// Second pass where masses differ so much that a double loses the gap rates.
  void correct_component();

  ContactOperator operator_;
  InterfaceGather gather_;
  double gap_tolerance_;
  std::vector<double> initial_gap_;
  std::vector<double> inverse_mass_;  ///< per interface dof
  std::vector<double> diagonal_;      ///< H_ii
  std::vector<std::vector<int>> components_;
  int coupled_rows_ = 0;
  std::vector<double> rate_norm_;
  std::vector<double> mine_;  ///< shape (owned, 3)
  std::vector<double> all_;   ///< shape (3, dofs): displacement, velocity before, free velocity
  std::vector<double> gap_;
  std::vector<double> impulse_;
  std::vector<double> previous_;  ///< impulses of the last solve: where the LCP starts
  std::vector<double> work_;
  std::vector<char> active_;
  std::vector<double> dof_impulse_;    ///< L^T lambda
  std::vector<double> dof_increment_;  ///< L^T of the correction
  double smallest_gap_ = 0;
  double largest_residual_ = 0;
  std::unique_ptr<LcpSolver> lcp_;
  std::vector<int> active_rows_;
  std::vector<double> matrix_;
  std::vector<double> rate_;
  std::vector<double> solution_;
  std::vector<double> increment_;
};

}  // namespace pounding
