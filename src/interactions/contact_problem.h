#pragma once

#include <memory>
#include <set>
#include <span>
#include <vector>

#include "common/saved_state.h"
#include "interactions/frictional_contact.h"
#include "interactions/interface_rows.h"
#include "interactions/pairing/interface.h"
#include "interactions/shared_rows.h"
#include "interactions/sliding_pairs.h"
#include "solvers/proportioning.h"
#include "solvers/sparse_rows.h"
#include "system/linear_system.h"

namespace pounding::interactions {

/// The unilateral contact problem of one step, solved where the nodes of its rows are:
///
///     A = { i : g_i(u_n) <= g_tol },     0 <= lambda _|_ H lambda + L v_free >= 0   on A
///
/// The columns of L are displacements of the interface, T u of the dofs of each structure (see
/// system/trace.h), so that H = L T M^-1 T^T L^T [1/kg]; it is built once. Rows that share nothing
/// that moves with another row are solved in closed form, lambda_i = max(0, -(L v_free)_i / H_ii);
/// coupled rows by CoupledLcp, component by component; components with friction have tangential
/// impulses beside the normal ones (see FrictionalContact). Nothing allocates after construction,
/// but where sliding pairs are found anew: then L and H are built again.
///
/// A component, a lone row above all, is held by every rank that knows one of its dofs. These solve
/// it alike, to the bit, from values that they bring each other, so that no answer is sent. One of
/// them counts it: there its results are added up. A large component without friction is solved by
/// its ranks together, each of which holds and counts its share of the rows (see SharedRows).
/// Sliding pairs are held by all members.
class ContactProblem {
 public:
  /// Collective over `comm`. `gap_tolerance` [m].
  ContactProblem(MPI_Comm comm, const Interface& interface, std::span<const LinearSystem> systems,
                 std::span<const Mesh> meshes, double gap_tolerance);

  /// Says how long the steps are [s], by which sliding pairs are looked at.
  void set_time_step(double time_step) { sliding_.set_time_step(time_step); }

  bool member() const { return interface_.member(); }
  int root() const { return interface_.root(); }
  int members() const { return interface_.members(); }
  MPI_Comm comm() const { return interface_.comm(); }  ///< of the members; null elsewhere
  /// Rows of this rank, ascending, whose results are added up here: each is counted by one member.
  std::span<const int> counted() const { return counted_; }
  /// Every member holds all rows. The same on all of them.
  bool alike() const { return alike_; }
  /// Values travel between this rank and others.
  bool exchanges() const { return interface_.exchanges(); }
  /// Constraints, friction apart.
  int rows() const { return static_cast<int>(initial_gap_.size()); }
  int coupled_rows() const { return coupled_rows_; }

  /// The interface of a structure, as far as this rank knows it.
  const Trace& trace(std::size_t structure) const { return interface_.trace(structure); }
  /// u_n over the owned dofs of the structure; `supports`: that of the supports, see Trace::apply.
  void set_displacement(std::size_t structure, const double* displacement,
                        std::span<const double> supports = {}) {
    interface_.set(structure, 0, 1, displacement, supports);
  }
  /// u_n at the known points of the structure's trace, where it is at hand, in place of that over
  /// the dofs; the supports carry them along.
  void set_point_displacement(std::size_t structure, std::span<const double> points,
                              std::span<const double> supports) {
    interface_.set_points(structure, points, supports);
  }
  /// The places of dof_list() move beside their structures: displacement [m], and velocity
  /// before and in the step [m/s], which the next gathers add. Members only.
  struct Carried {
    std::vector<double> displacement;
    std::vector<double> velocity_before;
    std::vector<double> velocity;
  };
  void carry(const Carried& carried) { carried_ = &carried; }
  /// Gathers the displacements, finds sliding pairs anew and computes the gaps. Members only,
  /// collective over them.
  void gather_displacements();
  /// Active set among the rows that this rank holds; true if it is not empty, or if that of a
  /// component is not in which this rank has a share. Members only, collective over them.
  bool detect_contact();
  /// v_{n-1/2} and v_free over the owned dofs of the structure, after the displacements of both
  /// have been gathered; `supports`: those of the supports likewise.
  void set_velocity_before(std::size_t structure, const double* velocity,
                           std::span<const double> supports = {}) {
    interface_.set(structure, 0, 2, velocity, supports);
  }
  void set_free_velocity(std::size_t structure, const double* velocity,
                         std::span<const double> supports = {}) {
    interface_.set(structure, 1, 2, velocity, supports);
  }
  /// Gathers the velocities. Members only, collective over them.
  void gather_velocities();
  /// Impulses of the active rows, 0 elsewhere. Collective over the ranks that share rows of which
  /// some are active.
  void solve_impulse();
  /// No impulse anywhere, as of solve_impulse() with an empty active set.
  void clear_impulse();
  /// v += M^-1 T^T L^T lambda over the dofs of the structure's trace.
  void add_velocity_change(std::size_t structure, double* velocity);
  /// Work of the impulses, friction's included, on a structure's supports that move with `velocity`
  /// [J]: that of the points that this rank knows.
  double support_work(std::size_t structure, std::span<const double> velocity);

  /// Results per row, of those that this rank holds. Gaps of the faces in the last gather, below
  /// zero where they are crushed. Members only.
  const std::vector<double>& gaps() const { return crushes_ ? face_gap_ : gap_; }  ///< [m]
  const std::vector<double>& impulses() const { return impulse_; }                 ///< [N s]
  const std::vector<double>& works() const { return work_; }  ///< 1/2 lambda L v- [J]
  double smallest_gap() const { return smallest_gap_; }
  /// Contact work 1/2 lambda^T L v- of the last solve, that of friction apart, and the loss of
  /// friction [J]: of the rows that this rank counts.
  double total_work() const { return sum_of_counted(work_); }
  double total_friction_loss() const {
    return friction_.has_any() ? sum_of_counted(friction_.losses()) : 0;
  }
  const FrictionalContact& friction() const { return friction_; }
  /// Points that contacts move, the same on every rank.
  const std::vector<InterfaceDof>& dof_list() const { return interface_.rows().dof_list(); }
  /// Adds the impulses L^T lambda of the last solve, friction's included, to `sum` [N s], per point
  /// of dof_list() that this rank knows. Members only.
  void add_dof_impulses(std::span<double> sum) const;
  double largest_residual() const { return largest_residual_; }
  double gap_tolerance() const { return gap_tolerance_; }
  /// A structure's part of (row of L T)^T over the dofs that this rank owns.
  std::vector<double> row_force(int row, std::size_t structure, LocalIndex owned_dofs) const;
  /// L M^-1 L^T of a row with only one structure's columns [1/kg]; the same on all ranks.
  double row_compliance(int row, std::size_t structure) const;
  /// See InterfaceGather. Members only, collective over them.
  void reduce(MPI_Op operation, std::span<double> values) { interface_.reduce(operation, values); }

  /// The impulses of the last solve, from which the LCP starts, and the largest residual.
  /// Collective over the members where it puts them away.
  void keep(const StateKeeper& state);

 private:
  /// Coupled rows, ascending, with their part of H: those that this rank solves.
  struct Component {
    std::vector<int> rows;
    SparseRows delassus;  ///< without rows for a single row, with friction, or where `many` has it
    int frictional = -1;  ///< its number there; -1: no row has friction
    std::unique_ptr<SharedRows> share{};          ///< null: there are no others
    std::unique_ptr<ProportioningSolver> many{};  ///< null: few rows
    std::vector<double> numbered{};               ///< values of all shares, per number
    bool acts = false;                            ///< a row of some share is active
  };

  /// Which ranks hold a component.
  struct Holders {
    int first = 0;
    int last = 0;
    int count = 0;
    bool here = false;
  };

  /// H, its components and room for them, from the rows of L as they are.
  void build_delassus();
  void take_new_pairs();
  /// Source of components, and the dofs found in them so far.
  struct Building {
    DelassusPattern pattern;
    std::vector<std::vector<int>> row_dofs;  ///< per row, friction's included
    std::vector<int> number;                 ///< per row of L in its component
    std::set<int> wanted;                    ///< dofs of held rows
  };

  void find_components();
  /// Per component. Collective over the members; elsewhere nothing is held.
  std::vector<Holders> find_holders(std::span<const std::vector<int>> components,
                                    std::span<const std::vector<int>> row_dofs);
  /// Adds the rows that this rank solves of a component. Collective over the members.
  void add_component(const std::vector<int>& rows, const Holders& holders, bool counts,
                     Building& building);
  /// The share of this rank in a component, if it is shared. Collective over the members.
  std::unique_ptr<SharedRows> share_of(const std::vector<int>& rows, const Holders& holders,
                                       Building& building);
  /// H of the component's rows and its solver.
  void build_rows(Component& component, Building& building);
  /// Velocity over the dofs in the last gather: 0 before, 1 free.
  std::span<const double> velocity(std::size_t which) const {
    return {velocities_.data() + which * displacement_.size(), displacement_.size()};
  }
  double sum_of_counted(std::span<const double> values) const;
  void solve_lone_rows();
  void solve_component(Component& component);
  void solve_with_friction(const Component& component);
  void solve_coupled(Component& component);
  /// Adds L^T of impulses of the component's active rows, and of those of others that are felt.
  void add_impulses(Component& component, std::span<const double> impulses, std::span<double> sum);
  /// Second pass where masses differ so much that a double loses the gap rates.
  void correct_component(Component& component);
  /// Keeps the residual of the system just solved, if it is the largest; `rate`: its largest free
  /// gap rate.
  void note_residual(double residual, double rate);

  std::vector<Constraint> constraints_;  ///< as they are now
  InterfaceRows interface_;
  SlidingPairs sliding_;
  FrictionalContact friction_;
  double gap_tolerance_;
  std::vector<double> initial_gap_;
  std::vector<double> diagonal_;  ///< H_ii
  std::vector<char> may_act_;     ///< per row
  std::vector<int> held_;         ///< rows, ascending
  std::vector<int> counted_;
  bool alike_ = true;
  std::vector<int> lone_;              ///< held rows without friction that no other row feels
  std::vector<Component> components_;  ///< the other ones that are held
  int coupled_rows_ = 0;
  const Carried* carried_ = nullptr;  ///< null: nothing beside the structures
  std::vector<double> displacement_;  ///< per interface dof
  std::vector<double> velocities_;    ///< shape (2, dofs): before, free
  std::vector<double> gap_;
  bool crushes_ = false;          ///< strips of some faces are crushed
  std::vector<double> face_gap_;  ///< then: gaps without them
  std::vector<double> impulse_;
  std::vector<double> previous_;  ///< impulses of the last solve: where the LCP starts
  std::vector<double> work_;
  std::vector<char> active_;
  std::vector<double> dof_impulse_;    ///< L^T lambda
  std::vector<double> dof_increment_;  ///< L^T of the correction
  bool incremented_ = false;           ///< there is one
  double smallest_gap_ = 0;
  double largest_residual_ = 0;
  double largest_rate_ = 0;  ///< of the free gap rates so far [m/s]
  std::unique_ptr<CoupledLcp> lcp_;
  std::vector<std::size_t> active_indices_;  ///< of the component's active rows in it
  std::vector<double> rate_;
  std::vector<double> solution_;
  std::vector<double> increment_;
};

}  // namespace pounding::interactions
