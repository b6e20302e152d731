#include "fidelity/mesh_error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <vector>

#include "common/error.h"
#include "common/facts.h"
#include "common/memory.h"
#include "common/parallel.h"
#include "driver/build_model.h"
#include "elements/element_traits.h"
#include "fidelity/stepped_window.h"
#include "observers/observed_run.h"

namespace pounding {
namespace {

/// Mode of a structure up to which whole runs are compared.
constexpr std::size_t shifted_modes = 10;
/// Dofs of a mesh split twice up to which it shows the order.
constexpr double most_twice_split = 60000;
/// Contact points of a structure up to which each has a vector of its own on the split mesh:
/// patches are stiffer, and not symmetric where the faces are.
constexpr int most_points = 300;
/// Memory of a rank that has no model, about [bytes].
constexpr double empty_rank = 1e8;
/// Memory of a factor over the number of dofs, by an exponent: nested dissection in space.
constexpr double growth = 4.0 / 3;

/// Modes of a structure that is at full order in the run.
constexpr int modes_in_place = 100;

/// The scene with its structures at full order reduced, as far as modes can take their place.
Scene all_reduced(Scene scene) {
  for (Structure& structure : scene.structures) {
    const bool apart = std::ranges::any_of(
        structure.regions, [](const Region& region) { return region.damping.has_value(); });
    if (structure.modal || apart) continue;
    structure.modal.emplace().modes = modes_in_place;
    structure.mass_scaling = 0;
    structure.step_target.reset();
  }
  return scene;
}

/// Why the mesh of no structure can be split and the run made again; empty where it can.
std::string without_split(const Scene& scene) {
  if (std::ranges::none_of(scene.structures,
                           [](const Structure& structure) { return structure.matrices.empty(); })) {
    return "every structure is of matrices, whose mesh cannot be judged";
  }
  for (const Structure& structure : scene.structures) {
    if (!structure.modal) {
      return structure.name + " is at full order, and modes cannot take its place";
    }
    if (!structure.initial_state.empty()) {
      return "nodes of " + structure.name + " start on their own";
    }
  }
  for (const Probe& probe : scene.probes) {
    if (!probe.average && !probe.group.empty()) {
      return "probe " + probe.name + " has a record of each node";
    }
  }
  for (const Load& load : scene.loads) {
    if (load.force != Vector3{0, 0, 0} || load.moment != Vector3{0, 0, 0}) {
      return "load " + load.name + " acts on single nodes";
    }
  }
  return "";
}

/// Dofs of a structure on its mesh split once beside those that it has, about.
double split_factor(const Structure& structure) {
  double factor = 1;
  for (const Region& region : structure.regions) {
    const int gmsh_type = traits_of(region.element).gmsh_type;
    if (gmsh_type > 3) factor = std::max(factor, gmsh_type == 15 ? 1.0 : 8.0);
    if (gmsh_type == 2 || gmsh_type == 3) factor = std::max(factor, 4.0);
    if (is_beam(region.element)) factor = std::max(factor, 2.0);
  }
  return structure.matrices.empty() ? factor : 1;
}

/// Dofs of all structures on their meshes split so many times, about.
double split_dofs(const Scene& scene, const Model& model, int splits) {
  double dofs = 0;
  for (std::size_t s = 0; s < scene.structures.size(); ++s) {
    dofs += static_cast<double>(model.meshes[s].global_dofs) *
            std::pow(split_factor(scene.structures[s]), splits);
  }
  return dofs;
}

/// A reduced scene for a finer mesh: as many modes, and a vector for each point of its faces, of
/// more than some hundred as many patches as `model`, the reduced one on the mesh as it is, has.
Scene split_scene(Scene scene, const Model& model) {
  for (std::size_t s = 0; s < scene.structures.size(); ++s) {
    Structure& structure = scene.structures[s];
    structure.modal->basis_file.clear();
    if (!structure.matrices.empty()) continue;
    const ModalBasis* basis = model.buildings[s].basis_or_null();
    if (structure.modal->patches == 0 && basis != nullptr) {
      structure.modal->patches = std::max(basis->attachment_vectors, most_points);
    }
  }
  scene.mesh_pieces.clear();
  leave_outputs(scene);
  return scene;
}

/// A reduced run on a mesh that is split.
class SplitRun {
 public:
  /// `model`: on the mesh as it is; `window`: of a run with steps of `time_step` [s]. Collective.
  SplitRun(MPI_Comm comm, const Scene& scene, const Model& model, int splits, const Window& window,
           double time_step)
      : comm_(comm), splits_(splits), scene_(split_scene(scene, model)) {
    Profile profile;
    const std::vector<double> ones(scene_.structures.size(), 1.0);
    model_ = build_model(comm, scene_, ones, profile, {}, splits);
    const double interval = record_stride(scene_, model_) * model_.time_step;
    const auto step_at = [&](std::int64_t step) {
      const double time = static_cast<double>(step) * time_step;
      const std::int64_t last = model_.steps / record_stride(scene_, model_);
      return std::min<std::int64_t>(std::llround(time / interval), last) *
             record_stride(scene_, model_);
    };
    seen_ = see_window(comm, scene_, model_, {step_at(window.first), step_at(window.last), ""});
  }

  const Model& model() const { return model_; }
  Spectra whole() const { return of({0, seen_.velocities}); }
  /// Spectra of its window at full order. Collective.
  Spectra window() const {
    const SteppedWindow stepped(comm_, scene_, model_, seen_.window, seen_.state, splits_);
    return of({seen_.window.first, stepped.run(1).velocities});
  }

 private:
  Spectra of(const Records& records) const {
    return spectra_of(comm_, scene_, model_, *model_.motion, records);
  }

  MPI_Comm comm_;
  int splits_;
  Scene scene_;  ///< the model borrows from it
  Model model_;
  SeenWindow seen_;
};

/// Spectra of whole runs up to the tenth mode of each probe's structure, of windows above it.
Spectra joined_spectra(const Model& model, const Spectra& whole, Spectra window) {
  for (std::size_t c = 0; c < window.size(); ++c) {
    const auto s = static_cast<std::size_t>(model.probes[c / 3].structure);
    const std::vector<double>& squares = model.buildings[s].basis->squared_frequency;
    const double tenth =
        std::sqrt(squares[std::min(shifted_modes, squares.size()) - 1]) / (2 * std::numbers::pi);
    for (std::size_t i = 0; i < window[c].size() && window[c][i].frequency <= tenth; ++i) {
      window[c][i] = whole[c][i];
    }
  }
  return window;
}

/// Largest memory so far beyond that of ranks without a model, of all together [bytes]. Collective.
double memory_of_model(MPI_Comm comm) {
  double peak = std::max(0.0, largest_memory() - empty_rank);
  reduce_over_ranks(comm, MPI_SUM, peak);
  return peak;
}

/// Whether the memory for a mesh split once is there; its needs go to the estimate and the
/// console. Collective.
bool has_room(MPI_Comm comm, const Scene& scene, const Model& model, double seconds,
              FidelityEstimate& estimate) {
  const double factor = split_dofs(scene, model, 1) / split_dofs(scene, model, 0);
  estimate.split_memory =
      empty_rank * size_of(comm) + memory_of_model(comm) * std::pow(factor, growth);
  estimate.split_time = 2 * factor * seconds;
  double available = available_memory();
  MPI_Bcast(&available, 1, MPI_DOUBLE, 0, comm);
  estimate.mesh = no_room(factor, estimate.split_memory, available);
  if (estimate.mesh.empty() && rank_of(comm) == 0) {
    std::printf(
        "error of the mesh: split once it has about %.2g times the dofs and takes about "
        "%.2g GB, and more than %.2g s\n",
        factor, estimate.split_memory / 1e9, estimate.split_time);
    std::fflush(stdout);
  }
  return estimate.mesh.empty();
}

}  // namespace

std::string no_room(double factor, double memory, double available) {
  if (memory <= available) return "";
  return sentence(
      "split once it has about {:.2g} times the dofs and takes about {:.2g} GB, of which {:.2g} "
      "are free; run it where there are more",
      {factor, memory / 1e9, available / 1e9});
}

void add_mesh_error(MPI_Comm comm, const Scene& scene, const Model& model, const SeenWindow& seen,
                    const Spectra& full, std::span<const char> moving, double seconds,
                    FidelityEstimate& estimate) {
  const Scene reduced = all_reduced(scene);
  estimate.mesh = without_split(reduced);
  if (!estimate.mesh.empty() || !has_room(comm, scene, model, seconds, estimate)) return;
  const double began = MPI_Wtime();
  const auto run_split = [&](const Model& base, int splits) {
    return std::make_unique<const SplitRun>(comm, reduced, base, splits, seen.window,
                                            model.time_step);
  };
  try {
    const bool as_it_is = std::ranges::all_of(
        scene.structures, [](const Structure& s) { return s.modal.has_value(); });
    const std::unique_ptr<const SplitRun> own = as_it_is ? nullptr : run_split(model, 0);
    const Model& base = own ? own->model() : model;
    const Spectra whole =
        own ? own->whole() : spectra_of(comm, scene, model, *model.motion, {0, seen.velocities});
    const Spectra window = own ? own->window() : full;
    const std::unique_ptr<const SplitRun> split = run_split(base, 1);
    const Spectra split_whole = split->whole();
    ErrorPart part{"mesh", 2, false, {}, {}};
    const double change = rms_of_channels(distances(model, whole, split_whole, moving), 0);
    if (split_dofs(scene, model, 2) <= most_twice_split && change <= far_apart) {
      const Spectra twice = run_split(base, 2)->whole();
      part.order =
          order_of(change, rms_of_channels(distances(model, split_whole, twice, moving), 0));
      part.measured = true;
    }
    part.channels = distances(model, joined_spectra(base, whole, window),
                              joined_spectra(base, split_whole, split->window()), moving);
    part.extrapolate();
    estimate.split_dofs = split->model().dofs();
    estimate.parts.push_back(std::move(part));
  } catch (const UserError& error) {
    estimate.mesh = std::string("split once it is refused: ") + error.what();
  }
  for (const Structure& structure : scene.structures) {
    if (structure.matrices.empty() || !estimate.mesh.empty()) continue;
    estimate.mesh = structure.name + " is of matrices, whose mesh cannot be judged";
  }
  estimate.split_time = MPI_Wtime() - began;
  MPI_Bcast(&estimate.split_time, 1, MPI_DOUBLE, 0, comm);
}

}  // namespace pounding
