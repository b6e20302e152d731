#pragma once

#include <span>

#include "common/doubts.h"
#include "mesh/global_mesh.h"
#include "model/model.h"

/// Doubts about a model whose parts are each in order, and that cannot be meant as a whole. One
/// line each; the thresholds are in docs/reference/input-checks.md.
namespace pounding {

/// Doubts that whole meshes show: a mat on soil that is not level, contacts that go through a
/// building or across it, floors that are no floors. Serial, rank 0.
void add_place_doubts(const Scene& scene, std::span<const GlobalMesh> meshes,
                      const interactions::Interface& interface,
                      std::span<const ResolvedProbe> probes, Doubts doubts);

/// Doubts about a structure whose modes, if it is reduced and their error is not estimated, or
/// whose mesh (mesh/mesh_waves.h) end below the spectra of its probes. Of the mesh on rank 0 only.
void add_frequency_doubts(const Scene& scene, std::span<const ResolvedProbe> probes,
                          const Building& building, Doubts doubts);

/// Frequency of the highest mode in a basis [Hz].
double highest_mode(const ModalBasis& basis);

/// Doubts about masses and frequencies of a structure that is built: point masses that are nothing
/// beside the rest, matrices in other units. Collective.
void add_mass_doubts(MPI_Comm comm, const Building& building, Doubts doubts);

}  // namespace pounding
