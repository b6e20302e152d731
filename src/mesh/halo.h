#pragma once

#include <memory>
#include <span>
#include <vector>

#include <mpi.h>

#include "common/shared_exchange.h"
#include "common/types.h"

namespace pounding {

/// Forward exchange of dof values: each rank receives its ghosts from their owners, through common
/// memory where all ranks have it, else by persistent messages. Ranks that share nothing exchange
/// nothing; an exchange allocates nothing.
///
///     halo.begin(w);  ... work on owned values ...  halo.end();  ... work on halo.ghosts() ...
///
/// Ghost values lie grouped by owner: ghost i of the list given is at slot(i).
class Halo {
 public:
  /// `ghosts`: global numbers of the ghost dofs, each owned by another rank. Owned dofs are
  /// `first_owned` and the next `owned_count`, rank after rank. `common_memory`: false to send
  /// messages even within a node. Collective; `comm` is duplicated.
  Halo(MPI_Comm comm, GlobalIndex first_owned, LocalIndex owned_count,
       std::span<const GlobalIndex> ghosts, bool common_memory = true);
  Halo(const Halo&) = delete;
  Halo& operator=(const Halo&) = delete;
  ~Halo();

  /// Starts sending from `owned`, values by owned dof (a pointer, or an object indexed like one),
  /// which may change afterwards.
  template <typename Values>
  void begin(const Values& owned) {
    double* const sent = shared_ ? shared_->draft() : send_.data();
    for (std::size_t i = 0; i < sent_dofs_.size(); ++i) sent[i] = owned[sent_dofs_[i]];
    start();
  }
  /// Waits until all ghost values are here and all others have, or can still read, those of this
  /// rank.
  void end();

  const double* ghosts() const { return received_.data(); }
  std::size_t ghost_count() const { return received_.size(); }
  LocalIndex slot(std::size_t ghost) const { return slot_[ghost]; }
  /// Ranks that this one receives from or sends to.
  int neighbour_count() const { return static_cast<int>(neighbours_.size()); }
  bool uses_common_memory() const { return shared_ != nullptr; }

 private:
  /// A rank that this one receives from or sends to.
  struct Neighbour {
    int rank = 0;
    int received = 0;        ///< values from there
    int received_begin = 0;  ///< the first of them in received_
    int sent = 0;            ///< values to there
    int sent_begin = 0;      ///< the first of them among those that this rank sends
    int their_begin = 0;     ///< the first one for this rank among those that the other one sends
  };
  void prepare_messages();
  void start();

  MPI_Comm comm_ = MPI_COMM_NULL;
  std::vector<LocalIndex> slot_;
  std::vector<LocalIndex> sent_dofs_;  ///< owned dofs in the order in which they are sent
  std::vector<double> received_;
  std::vector<Neighbour> neighbours_;       ///< by rank
  std::unique_ptr<SharedExchange> shared_;  ///< null: messages
  std::vector<double> send_;                ///< of messages
  std::vector<MPI_Request> requests_;       ///< persistent: receives, then sends
};

}  // namespace pounding
