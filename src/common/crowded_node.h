#pragma once

#include <chrono>

namespace pounding {

/// Whether the launcher started more ranks on this node than there are processors for them to run
/// on: those of the launcher, of which it may have bound each rank to some. By a variable that Open
/// MPI's launcher sets, so that it can be asked before MPI_Init; false under another launcher. Not
/// collective.
bool crowded_node();

/// Has ranks that wait for messages give their processor to others, where the node is crowded or
/// all ranks are on this one: whoever waits without end may hold the processor that the awaited
/// rank needs, and on one node other programs have a part of them. Ranks of several nodes wait for
/// a network, whose messages should be seen at once. Before MPI_Init. Open MPI does so itself only
/// beyond the slots given to it, which may be more than processors. A choice of the user's
/// (OMPI_MCA_mpi_yield_when_idle) stays.
void yield_while_waiting();

/// Has ranks speak to each other through common memory alone, and listen at no address of the
/// network, where all of them are on this node: Open MPI's TCP, of one rank as well, would listen
/// at each. Before MPI_Init. Ranks of several nodes, those of another launcher or of a batch system
/// keep their network, and so does whoever chose one (OMPI_MCA_btl, OMPI_MCA_pml).
void listen_nowhere();

/// Whether more threads want to run on this node than it has processors, by the count of the kernel
/// (/proc/loadavg): a rank that waits should sleep then, since giving its processor away still
/// leaves it its share. False where that file cannot be read. Local.
class NodeLoad {
 public:
  /// Looks again after a fiftieth of a second.
  bool is_above_processors();

 private:
  std::chrono::steady_clock::time_point next_look_{};
  bool above_ = false;
};

}  // namespace pounding
