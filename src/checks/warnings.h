#pragma once

#include <span>
#include <string>
#include <vector>

#include <mpi.h>

#include "common/doubts.h"
#include "mesh/global_mesh.h"
#include "model/model.h"

namespace pounding {

/// Adds the doubts about a model that is built but for its time step, those about its meshes apart.
/// Collective.
void add_model_doubts(MPI_Comm comm, const Scene& scene, Model& model);

/// Structures or regions whose Rayleigh damping is above half of the critical one at a mode up to
/// 50 Hz, or at the first one; at 1 and 50 Hz where no modes were computed.
std::vector<std::string> damping_warnings(const Structure& structure, const ModalResult& modal);

/// Adds doubts about end time and time step beside the motion and the records: nothing that could
/// move, a record that ends before the run does, a step longer than a sample.
void add_step_doubts(const Scene& scene, const Model& model, Doubts doubts);

/// The line about a step longer than the time between two samples of `of`, both in s; none where it
/// is not.
void add_long_step(const std::string& of, double sample, double step, Doubts doubts);

/// Adds doubts about probes that may record another motion than was meant: far from the points
/// asked for, on clamped nodes, or on nodes of a contact. Serial, rank 0.
void add_probe_doubts(std::span<const ResolvedProbe> probes, std::span<const GlobalMesh> meshes,
                      const interactions::Interface& interface, Doubts doubts);

}  // namespace pounding
