#pragma once

#include <memory>
#include <span>
#include <vector>

#include <mpi.h>

#include "common/shared_exchange.h"
#include "interactions/contact_operator.h"
#include "interactions/delassus.h"
#include "system/linear_system.h"
#include "system/trace.h"

namespace pounding::interactions {

/// Brings values of interface dofs to the ranks that want them: at first all of them to every rank
/// that knows one. Those ranks form a communicator of their own; the others never take part. Since
/// values travel, not partial sums, results from them do not depend on the partition. On one node
/// they travel through common memory, else in messages, between ranks that want something of each
/// other alone.
class InterfaceGather {
 public:
  /// `mine`: interface dofs whose values this rank knows, in the order of its values; each is known
  /// to one rank. `common_memory`: false to send messages even within a node. Collective over
  /// `comm`.
  InterfaceGather(MPI_Comm comm, std::span<const int> mine, bool common_memory = true);
  InterfaceGather(const InterfaceGather&) = delete;
  InterfaceGather& operator=(const InterfaceGather&) = delete;
  ~InterfaceGather();

  bool member() const { return comm_ != MPI_COMM_NULL; }
  /// The lowest member, in ranks of the communicator given.
  int root() const { return root_; }
  int members() const { return members_; }
  MPI_Comm comm() const { return comm_; }  ///< of the members; null elsewhere

  /// Takes the values of these dofs alone from now on, and of those that this rank knows.
  /// Collective over the members.
  void want(std::span<const int> dofs);
  /// Values go to other members, or come from them.
  bool exchanges() const { return !partners_.empty(); }

  /// Gathers `fields` values per known dof. `mine`: shape (known, fields); `all`: shape
  /// (fields, interface dofs), of which those that are not wanted are left alone. Collective over
  /// the members. Allocates nothing.
  void gather(int fields, std::span<const double> mine, std::span<double> all);

  /// Adds up `sums` over the members and takes the least of `least`, in place, to the same bits on
  /// all. Collective over them. Allocates nothing.
  void agree(std::span<double> sums, std::span<double> least);
  /// Reduces values, all of them by MPI_SUM or MPI_MIN, likewise.
  void reduce(MPI_Op operation, std::span<double> values) {
    operation == MPI_SUM ? agree(values, {}) : agree({}, values);
  }

  static constexpr int max_fields = 2;

 private:
  /// A member that wants values of this one, or has some that this one wants.
  struct Partner {
    int rank = 0;
    std::vector<int> dofs;      ///< that are taken from it
    std::vector<int> places;    ///< of these among its known dofs
    std::vector<int> wants;     ///< places among the known dofs here
    std::vector<double> taken;  ///< messages: values of both
    std::vector<double> sent;
  };

  void exchange_messages(int fields, std::span<const double> mine);

  std::unique_ptr<SharedExchange> shared_;  ///< null: messages
  std::unique_ptr<SharedExchange> sums_;    ///< for `reduce`, where all wait for all
  MPI_Comm comm_ = MPI_COMM_NULL;
  int root_ = 0;
  int members_ = 0;
  std::vector<std::vector<int>> known_;  ///< per member, its interface dofs
  std::vector<Partner> partners_;
  std::vector<MPI_Request> requests_;
};

/// Brings `width` values per row to every rank of `comm` from the one that counts the row;
/// `counted`: rows of this rank. Collective.
void share_rows(MPI_Comm comm, std::span<const int> counted, std::size_t width,
                std::span<double> values);

/// The dofs of an operator that belong to each of some structures, in its order.
std::vector<std::vector<int>> dofs_by_structure(const ContactOperator& contact,
                                                std::size_t structures);

/// The traces of all structures at the dofs of an operator; `impulses`: see Trace.
std::vector<Trace> make_traces(const ContactOperator& contact,
                               std::span<const LinearSystem> systems, std::span<const Mesh> meshes,
                               bool impulses);

/// The dofs of the operator that this rank knows, structure by structure, in the order of the
/// values of the traces.
std::vector<int> known_dofs(std::span<const std::vector<int>> structure_dofs,
                            std::span<const Trace> traces);

/// Rows of L over points of structures that several ranks own, held alike by every rank that knows
/// one of these points: fields gathered at them, L M^-1 L^T, and impulses on the structures.
/// Allocates nothing after construction.
class InterfaceRows {
 public:
  /// `constraints`: the rows; dofs of `more` get columns as well. Collective over `comm`.
  InterfaceRows(MPI_Comm comm, const std::vector<Constraint>& constraints,
                std::span<const LinearSystem> systems, std::span<const Mesh> meshes,
                std::span<const ConstraintTerm> more = {});

  const ContactOperator& rows() const { return operator_; }
  ContactOperator& rows() { return operator_; }
  const InterfaceCompliance& compliance() const { return compliance_; }
  std::size_t dofs() const { return static_cast<std::size_t>(operator_.dofs()); }
  bool member() const { return gather_.member(); }  ///< this rank knows a dof of some row
  int root() const { return gather_.root(); }       ///< the lowest member
  int members() const { return gather_.members(); }
  MPI_Comm comm() const { return gather_.comm(); }
  bool exchanges() const { return gather_.exchanges(); }
  /// This rank knows the dof.
  bool knows(int dof) const { return known_point_[dof] >= 0; }
  void want(std::span<const int> dofs) { gather_.want(dofs); }  ///< see InterfaceGather
  std::size_t structure_of(std::size_t dof) const {
    return static_cast<std::size_t>(operator_.dof_list()[dof].structure);
  }
  /// The interface of a structure, as far as this rank knows it.
  const Trace& trace(std::size_t structure) const { return traces_[structure]; }

  /// Field number `field` of `fields` that are gathered together, from values over the owned dofs
  /// of a structure; `supports`: motion of the supports that carries it along, see Trace::apply.
  void set(std::size_t structure, std::size_t field, std::size_t fields, const double* owned,
           std::span<const double> supports);
  /// A single field from its values at the known points of the structure's trace, which `supports`
  /// carry along.
  void set_points(std::size_t structure, std::span<const double> points,
                  std::span<const double> supports);
  /// Gathers the fields that were set: shape (fields, dofs), as far as dofs are wanted. Members
  /// only, collective over them.
  void gather(std::size_t fields, std::span<double> values);
  /// owned += f (row of L T)^T over the dofs of a structure that this rank owns. Local.
  void add_force(int row, double f, std::size_t structure, std::span<double> owned) const;
  /// See InterfaceGather. Members only, collective over them.
  void reduce(MPI_Op operation, std::span<double> values) { gather_.reduce(operation, values); }

  /// v += M^-1 T^T f over the dofs of the structure's trace, f [N s] over the dofs of the rows.
  void add_velocity_change(std::size_t structure, std::span<const double> impulses,
                           double* velocity);
  /// Work of impulses f on a structure's supports that move with `velocity` [J]: that of the points
  /// that this rank knows.
  double support_work(std::size_t structure, std::span<const double> impulses,
                      std::span<const double> velocity);

 private:
  /// f at the known points of a structure.
  void pick(std::size_t structure, std::span<const double> impulses);

  ContactOperator operator_;
  std::vector<std::vector<int>> structure_dofs_;  ///< per structure: its dofs of the operator
  std::vector<Trace> traces_;                     ///< per structure
  std::vector<std::size_t> first_known_;          ///< per structure, into the values of this rank
  std::vector<int> known_point_;  ///< per dof: point in its structure's trace; -1: not known here
  InterfaceGather gather_;
  InterfaceCompliance compliance_;
  std::vector<double> mine_;           ///< shape (known, fields)
  std::vector<double> point_impulse_;  ///< of the known points of a structure
};

}  // namespace pounding::interactions
