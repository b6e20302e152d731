#pragma once

#include <span>
#include <vector>

#include <mpi.h>

#include "common/types.h"

namespace pounding {

/// Forward exchange of dof values: each rank receives its ghosts from their owners. Ranks that
/// share nothing exchange nothing; an exchange allocates nothing.
///
///     halo.begin(w);  ... work on owned values ...  halo.end();  ... work on halo.ghosts() ...
///
/// Ghost values lie grouped by owner: ghost i of the list given stands at place(i).
class Halo {
 public:
  /// `ghosts`: global numbers of the ghost dofs, each owned by another rank. Owned dofs are
  /// `first_owned` and the next `owned_count`, rank after rank. Collective; `comm` is duplicated.
  Halo(MPI_Comm comm, GlobalIndex first_owned, LocalIndex owned_count,
       std::span<const GlobalIndex> ghosts);
  Halo(const Halo&) = delete;
  Halo& operator=(const Halo&) = delete;
  ~Halo();

  /// Starts sending from `owned`, values by owned dof (a pointer, or what is indexed like one),
  /// which may change afterwards.
  template <typename Values>
  void begin(const Values& owned) {
    for (std::size_t i = 0; i < send_.size(); ++i) {
      send_[i] = owned[sent_dofs_[i]];
    }
    start();
  }
  /// Waits until all ghost values are here and all messages have left.
  void end();

  const double* ghosts() const { return received_.data(); }
  std::size_t ghost_count() const { return received_.size(); }
  LocalIndex place(std::size_t ghost) const { return place_[ghost]; }
  /// Ranks that this one receives from or sends to.
  int neighbour_count() const { return neighbour_count_; }

 private:
  void start();

  MPI_Comm comm_ = MPI_COMM_NULL;
  std::vector<LocalIndex> place_;
  std::vector<LocalIndex> sent_dofs_;  ///< owned dofs in the order of send_
  std::vector<double> send_;
  std::vector<double> received_;
  std::vector<MPI_Request> requests_;  ///< persistent: receives, then sends
  int neighbour_count_ = 0;
};

}  // namespace pounding
