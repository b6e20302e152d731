#pragma once

#include <span>
#include <string>
#include <vector>

#include <mpi.h>

#include "mesh/global_mesh.h"
#include "model/model.h"

/// Lines of doubt, each about one thing that a user should look at. The program prints them with
/// "warning: " before them and lists them in summary.json.
namespace pounding {

/// Adds lines to a list.
inline void append(const std::vector<std::string>& lines, std::vector<std::string>& to) {
  to.insert(to.end(), lines.begin(), lines.end());
}

/// Adds the doubts about a model that is built but for its time step, those about its meshes apart.
/// Collective.
void add_model_doubts(MPI_Comm comm, const Scene& scene, Model& model);

/// Structures or regions whose Rayleigh damping is above half of the critical one at a mode up to
/// 50 Hz, or at the first one; at 1 and 50 Hz where no modes were computed.
std::vector<std::string> damping_warnings(const Structure& structure, const ModalResult& modal);

/// Doubts about end time and time step beside the motion and the records: nothing that could
/// move, a record that ends before the run does, a step longer than a sample. One line each.
std::vector<std::string> run_warnings(const Scene& scene, const Model& model);

/// The line about a step longer than the time between two samples of `of`, both in s; none where it
/// is not.
void add_long_step(const std::string& of, double sample, double step,
                   std::vector<std::string>& warnings);

/// Probes that may record another motion than was meant: far from the points asked for, on clamped
/// nodes, or on nodes of a contact. One line each. Serial, rank 0.
std::vector<std::string> probe_warnings(std::span<const ResolvedProbe> probes,
                                        std::span<const GlobalMesh> meshes,
                                        const interactions::Interface& interface);

}  // namespace pounding
