#pragma once

#include <functional>
#include <string>
#include <vector>

#include <mpi.h>

#include "driver/whole_meshes.h"
#include "mesh/mesh_parcel.h"
#include "model/model.h"
#include "scene/scene.h"

/// Meshes of a scene cut for a number of ranks, in a folder, so that no rank of a run holds one
/// whole and none waits for Gmsh:
///
///     common.piece       findings in the whole meshes: contacts, probes, checks, supports, ties
///     piece-00003.bin    that of rank 3: its part of every structure
///
/// Sealed (io/file_seal.h), for machines of one kind and one version of the program; what they were
/// made of is in the first.
namespace pounding {

/// Runs a scene up to the cut meshes and writes them for as many ranks as it asks for, of which it
/// prints an account. Needs no more ranks than one. Throws UserError. Collective.
void write_mesh_pieces(MPI_Comm comm, Scene& scene, Profile& profile);

/// Writes the piece of one rank, structure after structure; returns its size [bytes]. Throws
/// UserError. Serial.
double write_mesh_piece(const Scene& scene, int rank, const std::string& identity,
                        const std::function<MeshParcel(std::size_t)>& parcel_of);

/// Part of the pieces that all ranks have in common.
struct CommonPiece {
  WholeMeshes whole;     ///< of the meshes only the marks in them
  std::string identity;  ///< of the cut
};

/// Reads that, and the findings of rank 0 into `model`. Throws UserError where there are no pieces,
/// where they are of another model or for another number of ranks than `ranks`, and where they are
/// damaged. Rank 0.
CommonPiece read_common_piece(const Scene& scene, int ranks, Model& model);

/// The piece of one rank: a parcel per structure. Throws UserError where it is missing, damaged or
/// of another cut. Serial.
std::vector<MeshParcel> read_mesh_piece(const Scene& scene, int rank, const std::string& identity);

}  // namespace pounding
