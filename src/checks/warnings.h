#pragma once

#include <span>
#include <string>
#include <vector>

#include "mesh/global_mesh.h"
#include "model/model.h"
#include "observers/run_statistics.h"

/// Lines of doubt, each about one thing that a user should look at. The program prints them with
/// "warning: " before them and lists them in summary.json.
namespace pounding {

/// Adds lines to a list.
inline void append(const std::vector<std::string>& lines, std::vector<std::string>& to) {
  to.insert(to.end(), lines.begin(), lines.end());
}

/// Elements that cost the whole structure its time step, mostly by an accident of meshing.
std::vector<std::string> sliver_warnings(const LinearSystem& system);

/// Structures or regions whose Rayleigh damping is above half of the critical one at a mode up to
/// 50 Hz, or at the first one; at 1 and 50 Hz where no modes were computed.
std::vector<std::string> damping_warnings(const Structure& structure, const ModalResult& modal);

/// A doubt about uniform damping that moves a mode below 33 Hz, where floors amplify the ground, by
/// more than a tenth of its frequency: the worst of them.
std::vector<std::string> shift_warnings(const LinearSystem& system, const ModalResult& modal);

/// Modes without stiffness in structures whose supports prevent every rigid motion: mechanisms.
/// Rank 0 only.
std::vector<std::string> mechanism_warnings(const Scene& scene, const Model& model);

/// Doubts that the recorded motion raises about small displacements. `largest`: displacement
/// [m]; `model_size`: largest extent of the scene [m].
std::vector<std::string> displacement_warnings(double largest, double model_size);

/// Steps whose contact problem was not solved to the end. `residual`: the largest complementarity
/// residual of the run [-].
std::vector<std::string> contact_warnings(double residual);

/// Contacts whose faces slid so far that nodes may have left the facets that they are paired with.
std::vector<std::string> slide_warnings(const Scene& scene, const RunStatistics& statistics);

/// Contacts of one pass whose primary went deep into their secondary.
std::vector<std::string> pass_warnings(const Scene& scene, std::span<const OtherPass> passes);

/// Names of all that a closing factor multiplies: "motion", "motion and loads" where some of those
/// are not in the rest from which a run starts, "weight" likewise.
std::string scaled_by_closing(const Scene& scene);

/// A doubt about closing factors that multiply more than the motion, where joints stayed open.
std::vector<std::string> closing_warnings(const Scene& scene, const RunStatistics& statistics);

/// Names pendulums that were pressed so hard that their slope was cut.
std::vector<std::string> pendulum_warnings(const RunStatistics& statistics);

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
