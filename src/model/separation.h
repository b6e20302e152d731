#pragma once

#include <vector>

#include <mpi.h>

#include "model/model.h"

namespace pounding {

/// Share of each reported mode of a structure in the gap of every contact row, shape (modes, rows)
/// [kg^-1/2], the same on all ranks. Needs the shapes of the modes, or the basis of a reduced
/// structure, whose rows are read on the ranks that have them. Collective.
std::vector<double> modes_at_contacts(MPI_Comm comm, const Model& model, std::size_t structure);

/// Separations of the contacts between two structures, or a structure and a wall, of which the
/// modes are known. None where the ground rests or does not move as one. Rank 0.
std::vector<Separation> find_separations(const Scene& scene, const Model& model);

}  // namespace pounding
