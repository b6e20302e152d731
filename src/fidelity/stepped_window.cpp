#include "fidelity/stepped_window.h"

#include <algorithm>
#include <functional>

#include "common/parallel.h"
#include "driver/build_model.h"
#include "fidelity/inherited_motion.h"
#include "fidelity/probe_means.h"
#include "observers/observed_run.h"

namespace pounding {
namespace {

/// The scene of a reduced model with every structure at full order, no mass scaled.
Scene at_full_order(Scene scene, const Model& model) {
  for (std::size_t s = 0; s < scene.structures.size(); ++s) {
    Structure& structure = scene.structures[s];
    if (structure.uniform_damping) {
      structure.uniform_damping->reference = model.systems[s].uniform_damping->reference;
    }
    structure.modal.reset();
    structure.mass_scaling = 0;
    structure.step_target.reset();
  }
  if (std::ranges::none_of(scene.structures, &Structure::p_delta)) {
    scene.preload = false;
    for (Structure& structure : scene.structures) structure.gravity = {0, 0, 0};
    for (Contact& contact : scene.contacts) contact.gap_at_rest = false;
  }
  scene.modes = 0;
  leave_outputs(scene);
  return scene;
}

/// Systems at rest in their place, which nothing but the ground and contact moves.
void set_free(Model& model) {
  for (LinearSystem& system : model.systems) {
    system.initial_displacement = system.initial_velocity = system.gravity = {0, 0, 0};
    system.start.reset();
    system.rest_displacement.clear();
    system.loads.reset();
  }
}

/// Velocities of the channels at full order at the times of the records, this rank's part.
std::vector<double> run_window(const Window& window, InheritedMotion& inherited, int stride,
                               double reduced_step, double step, ProbeMeans& means,
                               ModelScheme& scheme, const std::function<void()>& after_step) {
  const std::size_t channels = means.channels();
  interactions::ContactProblem::Carried carried;
  std::vector<double> next(inherited.dofs());
  carried.displacement.resize(next.size());
  carried.velocity.resize(next.size());
  inherited.places(0, carried.displacement);
  if (scheme.contact() != nullptr) scheme.contact()->carry(carried);
  std::vector<double> records(channels, 0.0);
  std::vector<double> before(channels, 0.0);
  std::vector<double> now(channels);
  double time_before = 0;
  const std::int64_t wanted = (window.last - window.first) / stride;
  for (std::int64_t n = 0, made = 1; made <= wanted; ++n) {
    inherited.places(static_cast<double>(n + 1) * step, next);
    carried.velocity_before = carried.velocity;
    for (std::size_t i = 0; i < next.size(); ++i) {
      carried.velocity[i] = (next[i] - carried.displacement[i]) / step;
    }
    if (n == 0) carried.velocity_before = carried.velocity;
    scheme.stepper().step(true, false);
    after_step();
    carried.displacement = next;
    means.velocities(scheme.stepper().state(), now);
    const double time = (static_cast<double>(n) + 0.5) * step;
    for (; made <= wanted; ++made) {
      const double due = (static_cast<double>(made * stride) - 0.5) * reduced_step;
      if (due > time) break;
      const double share = (due - time_before) / (time - time_before);
      for (std::size_t c = 0; c < channels; ++c) {
        records.push_back(before[c] + share * (now[c] - before[c]));
      }
    }
    before.swap(now);
    time_before = time;
  }
  return records;
}

/// The scene's structures at full order, which nothing but the ground and contact moves; no step is
/// longer than `most` [s]. Collective.
Model build_free(MPI_Comm comm, Scene& full_scene, double most, int splits, Profile& profile) {
  const std::vector<double> ones(full_scene.structures.size(), 1.0);
  Model full = build_model(comm, full_scene, ones, profile, {}, splits);
  full.time_step = std::min(full.time_step, most);
  set_free(full);
  return full;
}

}  // namespace

SteppedWindow::SteppedWindow(MPI_Comm comm, const Scene& scene, const Model& model,
                             const Window& window, const SavedState& state, int splits)
    : comm_(comm),
      scene_(scene),
      model_(model),
      window_(window),
      state_(state),
      full_scene_(at_full_order(scene, model)),
      full_(build_free(comm, full_scene_, model.time_step, splits, profile_)) {}

SteppedWindow::Motion SteppedWindow::run(int parts) const {
  InheritedMotion inherited(comm_, scene_, model_, window_.first, state_, profile_);
  const GroundMotion driving =
      model_.motion->part(GroundMotion::Part::sets_in, start(), start() + fade_in)
          .counted_from(start());
  ModelScheme::Parts of_scheme = scheme_parts(comm_, full_scene_, full_, full_.meshes, profile_);
  of_scheme.interface = &model_.interface;
  of_scheme.motion = &driving;
  of_scheme.loads = nullptr;
  of_scheme.carried = true;
  of_scheme.time_step /= parts;
  const double step = of_scheme.time_step;
  ModelScheme scheme(std::move(of_scheme));
  ProbeMeans means(full_.probes, full_.systems, full_.meshes);
  Motion motion;
  MPI_Barrier(comm_);
  const double began = MPI_Wtime();
  motion.velocities =
      run_window(window_, inherited, record_stride(scene_, model_), model_.time_step, step, means,
                 scheme, [&] { add_impulses(scheme, motion.impulse); });
  motion.seconds = MPI_Wtime() - began;
  MPI_Bcast(&motion.seconds, 1, MPI_DOUBLE, 0, comm_);
  reduce_over_ranks(comm_, MPI_SUM, motion.impulse);
  inherited.finish(window_.last);
  const std::vector<double>& carried = inherited.records();
  for (std::size_t i = 0; i < motion.velocities.size(); ++i) motion.velocities[i] += carried[i];
  reduce_over_ranks(comm_, MPI_SUM, motion.velocities);
  return motion;
}

void leave_outputs(Scene& scene) {
  scene.write_modes = false;
  scene.time_step = 0;
  scene.warnings.clear();
  scene.forces.clear();
  scene.loops.clear();
  scene.fields_interval = 0;
  scene.export_matrices.clear();
}

void add_impulses(ModelScheme& scheme, double& sum) {
  if (!scheme.rows_act()) return;
  const std::span<const double> impulses = scheme.row_actions().impulses;
  for (const int row : scheme.contact()->counted()) sum += impulses[row];
}

}  // namespace pounding
