#pragma once

#include <map>
#include <span>
#include <string>

#include <mpi.h>

#include "common/saved_state.h"
#include "mesh/mesh.h"
#include "system/linear_system.h"

/// `checkpoint.h5`: all that a run needs to go on as if it had never stopped. The file says nothing
/// about ranks but for the parts of sums, so any number of them may read it. Values of nodes are
/// written and read by all ranks, a block of nodes each (file_blocks.h), the rest by rank 0.
///
///     /                            attributes: format "pounding checkpoint", schema (io/schema.h),
///                                  program, time_step [s], ground_motion (hash of its samples)
///     /options                     strings "name: value", those that may not change
///     /structures/S                attributes: dofs (free ones), elements
///     /structures/S/coordinates    (nodes, 3) [m]
///     /structures/S/displacement   (nodes, 3 or 6) u_{n+1} [m, rad]
///     /structures/S/velocity       (nodes, 3 or 6) v_{n+1/2} [m/s, rad/s]
///     /structures/S/...            (nodes, 3 or 6) other values per dof
///     /tables/step                 n, the last step made
///     /tables/...                  vectors and tables of whoever keeps a state
///     /sums/...                    (ranks, n) numbers that add up over the ranks
///
/// A structure in generalised coordinates has, beside its coordinates, plain vectors of its own
/// number of dofs, and `basis_check`, by which another basis is noticed.
///
/// S is the name of a structure. Nodes come in the order of their tags in the mesh, of those that
/// the scene uses; columns are x, y, z and, if a node of the structure rotates, the rotations about
/// them; the value of a clamped or missing component is 0 and not read.
/// Python reads and writes it:
///
///     with h5py.File("results/checkpoint.h5", "r+") as file:
///         x = file["structures/left/coordinates"][:]
///         file["structures/left/velocity"][x[:, 2] > 5, 0] += 0.1
///
/// The file is sealed (output/file_seal.h): after such a change, run/seal results/checkpoint.h5.
/// Energy that a change brings in is in no ledger: beyond round-off the identity no longer closes
/// and the run stops, unless the initial energy in sums/energy follows.
namespace pounding {

/// Identity that a checkpoint shares with the runs that may continue it, beside the meshes.
struct RunIdentity {
  std::map<std::string, std::string> options;  ///< that may not change, by name
  double time_step = 0;                        ///< [s]
  std::string ground_motion;                   ///< hash of the samples
  double beam_frequency = 0;  ///< highest of the spectra, if beams follow it; else 0 [Hz]
};

/// Writes beside `path`, then renames, so that there is a whole file at any moment. Throws
/// UserError (no space). Collective.
void write_checkpoint(MPI_Comm comm, const std::string& path, const RunIdentity& identity,
                      std::span<const Mesh> meshes, std::span<const LinearSystem> systems,
                      const SavedState& saved);

/// Refuses a file that is no checkpoint or was written under other options, before any work is
/// done. Throws UserError on every rank alike. Collective.
void check_checkpoint(MPI_Comm comm, const std::string& path,
                      const std::map<std::string, std::string>& options);

/// Reads the state given to `write_checkpoint`. Throws UserError on every rank: no checkpoint,
/// damaged, of another version, of another scene. Collective.
SavedState read_checkpoint(MPI_Comm comm, const std::string& path, const RunIdentity& identity,
                           std::span<const Mesh> meshes, std::span<const LinearSystem> systems);

}  // namespace pounding
