#pragma once

namespace pounding {

/// Whether the launcher started more ranks on this node than there are processors for them to run
/// on: those of the launcher, of which it may have bound each rank to some. By a variable that Open
/// MPI's launcher sets, so that it can be asked before MPI_Init; false under another launcher. Not
/// collective.
bool crowded_node();

/// Has ranks that wait for messages give their processor to others, where the node is crowded: one
/// that waits without end may hold the processor that the awaited rank needs. Before MPI_Init. Open
/// MPI does so itself only beyond the slots given to it, which may be more than processors. A
/// choice of the user's (OMPI_MCA_mpi_yield_when_idle) stays.
void yield_where_crowded();

}  // namespace pounding
