#pragma once

#include <span>
#include <string>

#include <mpi.h>

#include "fidelity/window_spectra.h"
#include "model/model.h"
#include "observers/run_statistics.h"
#include "scene/scene.h"

namespace pounding {

/// Why a mesh split once is not taken up: with `factor` times the dofs it needs more memory than is
/// available [bytes]; empty where that is there.
std::string no_room(double factor, double memory, double available);

/// Adds the error of the mesh to an estimate, or the reason why it is not judged: the scene's
/// structures once more with every element split (mesh/split_mesh.h), reduced alike, pairs of
/// contacts and nodes of probes searched anew. Up to the tenth mode of a probe's structure a mesh
/// shifts frequencies, which a short window does not resolve: there the whole reduced runs on the
/// two meshes are compared, above it their windows at full order. Structures that the run has at
/// full order are reduced for it on either mesh. Where structures are small the reduced run on a
/// mesh split twice shows the order; else it is taken to be 2. Not begun where its memory, as that
/// of the run so far and the number of dofs suggest, is not there. `seen`, `full`: the run and its
/// window at full order, `seconds`: that this took. Collective.
void add_mesh_error(MPI_Comm comm, const Scene& scene, const Model& model, const SeenWindow& seen,
                    const Spectra& full, std::span<const char> moving, double seconds,
                    FidelityEstimate& estimate);

}  // namespace pounding
