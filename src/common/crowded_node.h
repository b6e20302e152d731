#pragma once

#include <chrono>
#include <string>
#include <sys/types.h>

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

/// Open MPI keeps the common memory of ranks of one machine in files of /dev/shm, which stay behind
/// when a rank is killed. While this object lives the file of this rank has no name: every rank has
/// found the others' files before, and the memory lasts as long as a rank uses it. At the end there
/// is an empty file of that name, for Open MPI to remove. Does nothing under another MPI. To be
/// made by all ranks of MPI_COMM_WORLD after MPI_Init, and to end before MPI_Finalize.
class NamelessSegments {
 public:
  NamelessSegments();
  NamelessSegments(const NamelessSegments&) = delete;
  NamelessSegments& operator=(const NamelessSegments&) = delete;
  ~NamelessSegments();

 private:
  std::string path_;  ///< empty: there was none
};

/// The process that started another one of this machine; 0 where that is not to be seen.
pid_t parent_of(pid_t process);

}  // namespace pounding
