#include "fidelity/full_order_window.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "common/facts.h"
#include "common/parallel.h"
#include "driver/build_model.h"
#include "fidelity/inherited_motion.h"
#include "fidelity/probe_means.h"
#include "fidelity/window_place.h"
#include "model/model_scheme.h"
#include "motion/response_spectrum.h"
#include "observers/observed_run.h"
#include "scene/law_kinds.h"

namespace pounding {
namespace {

/// Part by which the ground's motion is changed at least and at most.
constexpr double least_disturbance = 1e-3;
constexpr double largest_disturbance = 0.2;

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
  scene.write_modes = false;
  scene.time_step = 0;
  scene.warnings.clear();
  scene.forces.clear();
  scene.loops.clear();
  scene.fields_interval = 0;
  scene.export_matrices.clear();
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

/// Sum of the impulses of a run, on the root of its contacts.
void add_impulses(MPI_Comm comm, ModelScheme& scheme, double& sum) {
  if (scheme.contact() == nullptr || scheme.contact()->root() != rank_of(comm)) return;
  if (!scheme.rows_act()) return;
  for (const double impulse : scheme.row_actions().impulses) sum += impulse;
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

using Spectra = std::vector<std::vector<SpectrumPoint>>;

/// Adds the ranks' parts of the channels' velocities up, in every record. Collective.
void add_parts(MPI_Comm comm, std::vector<double>& velocities) {
  constexpr std::size_t most = std::size_t{1} << 27;
  for (std::size_t i = 0; i < velocities.size(); i += most) {
    MPI_Allreduce(MPI_IN_PLACE, velocities.data() + i,
                  static_cast<int>(std::min(most, velocities.size() - i)), MPI_DOUBLE, MPI_SUM,
                  comm);
  }
}

/// Velocities of all channels in records that follow each other, the first of them made in a step.
struct Records {
  std::int64_t step = 0;
  std::span<const double> velocities;  ///< shape (records, channels) [m/s]
};

/// Spectra of the absolute acceleration of every channel, the mean from record to record, at the
/// scene's first damping ratio. The ranks share the channels out. Collective.
Spectra spectra_of(MPI_Comm comm, const Scene& scene, const Model& model,
                   const GroundMotion& motion, const Records& records) {
  const std::size_t channels = 3 * model.probes.size();
  const int stride = record_stride(scene, model);
  const double interval = model.time_step * stride;
  Spectra spectra(channels);
  for (std::size_t c = 0; c < channels; ++c) {
    if (static_cast<int>(c) % size_of(comm) != rank_of(comm)) continue;
    const int direction = static_cast<int>(c % 3);
    std::vector<double> acceleration;
    std::int64_t step = records.step + 1;
    for (std::size_t i = channels + c; i < records.velocities.size(); i += channels) {
      double change = records.velocities[i] - records.velocities[i - channels];
      for (int k = 0; k < stride; ++k, ++step) {
        const double time = static_cast<double>(step) * model.time_step;
        change += model.time_step * motion.acceleration(direction, time);
      }
      acceleration.push_back(change / interval);
    }
    spectra[c] = response_spectrum(acceleration, interval, scene.spectra.frequencies,
                                   scene.spectra.damping_ratios.front(), AfterRecord::ignored);
  }
  for (std::size_t c = 0; c < channels; ++c) {
    broadcast_array(comm, spectra[c], static_cast<int>(c) % size_of(comm));
  }
  return spectra;
}

/// The reduced run under a motion: velocities of the channels in all its records. `after_step` is
/// called after every one. Collective.
std::vector<double> run_reduced(MPI_Comm comm, const Scene& scene, const Model& model,
                                const GroundMotion& motion,
                                const std::function<void(ModelScheme&)>& after_step) {
  Profile profile;
  ModelScheme::Parts parts = scheme_parts(comm, scene, model, model.meshes, profile);
  parts.motion = &motion;
  ModelScheme scheme(std::move(parts));
  ProbeMeans means(model.probes, model.systems, model.meshes);
  const int stride = record_stride(scene, model);
  std::vector<double> velocities;
  std::vector<double> now(means.channels());
  for (std::int64_t n = 0; n <= model.steps; ++n) {
    scheme.stepper().step(false, false);
    after_step(scheme);
    if (n % stride != 0) continue;
    means.velocities(scheme.stepper().state(), now);
    velocities.insert(velocities.end(), now.begin(), now.end());
  }
  add_parts(comm, velocities);
  return velocities;
}

/// Distances of the channels that move.
std::vector<ChannelDistance> distances(const Model& model, const Spectra& found,
                                       const Spectra& reference, std::span<const char> moving) {
  std::vector<ChannelDistance> channels;
  for (std::size_t c = 0; c < moving.size(); ++c) {
    if (moving[c] == 0) continue;
    const std::string name = model.probes[c / 3].name + "." + direction_names[c % 3];
    channels.push_back(spectral_distance(name, found[c], reference[c]));
  }
  return channels;
}

/// Scaled mass at full order as single elements offer it, and its time for the whole run.
void offer_scaled_mass(const Model& full, FidelityEstimate& estimate) {
  if (full.step_source != StepSource::stability) return;
  double step = std::numeric_limits<double>::infinity();
  double cost = 1;
  for (const Building& building : full.buildings) {
    const ScalingOffer& offer = building.system->scaling_offer;
    const double stable = building.limits.stable_time_step;
    estimate.scaled_steps.push_back(offer.allowed > stable ? offer.time_step : 0);
    step = std::min(step, std::max(offer.allowed, stable));
    cost = std::max(cost, offer.cost);
  }
  estimate.scaled_run_time = estimate.full_run_time * cost * full.step_limits.stable / step;
}

/// Velocities of the sum of the inherited motion and of full order in the records of a window, and
/// its impulses. Collective.
std::vector<double> run_full_window(MPI_Comm comm, const Scene& scene, const Model& model,
                                    const Window& window, const SavedState& state,
                                    FidelityEstimate& estimate) {
  Profile profile;
  InheritedMotion inherited(comm, scene, model, window.first, state, profile);
  Scene full_scene = at_full_order(scene, model);
  const std::vector<double> ones(scene.structures.size(), 1.0);
  Model full = build_model(comm, full_scene, ones, profile);
  set_free(full);
  const double start = inherited.start();
  const GroundMotion driving =
      model.motion->part(GroundMotion::Part::sets_in, start, start + fade_in).counted_from(start);
  ModelScheme::Parts parts = scheme_parts(comm, full_scene, full, full.meshes, profile);
  parts.interface = &model.interface;
  parts.motion = &driving;
  parts.loads = nullptr;
  parts.carried = true;
  ModelScheme scheme(std::move(parts));
  ProbeMeans means(full.probes, full.systems, full.meshes);
  MPI_Barrier(comm);
  const double began = MPI_Wtime();
  std::vector<double> velocities =
      run_window(window, inherited, record_stride(scene, model), model.time_step, full.time_step,
                 means, scheme, [&] { add_impulses(comm, scheme, estimate.full_impulse); });
  double seconds = MPI_Wtime() - began;
  MPI_Bcast(&seconds, 1, MPI_DOUBLE, 0, comm);
  inherited.finish(window.last);
  for (std::size_t i = 0; i < velocities.size(); ++i) velocities[i] += inherited.records()[i];
  add_parts(comm, velocities);
  estimate.start = start;
  estimate.end = static_cast<double>(window.last) * model.time_step;
  estimate.full_dofs = full.dofs();
  estimate.time_step = full.time_step;
  estimate.full_run_time = seconds * scene.end_time / (estimate.end - start);
  offer_scaled_mass(full, estimate);
  return velocities;
}

}  // namespace

FidelityEstimate estimate_fidelity(MPI_Comm comm, const Scene& scene, const Model& model,
                                   const ImpactCatalogue& impacts, const Recorder& recorder,
                                   double length) {
  const double began = MPI_Wtime();
  FidelityEstimate estimate;
  const Window window = place_window(comm, scene, model, impacts, recorder, length);
  estimate.reason = window.reason;
  const std::size_t channels = 3 * model.probes.size();
  const int stride = record_stride(scene, model);

  SavedState state;  // in which the window begins
  const auto note_window = [&](ModelScheme& scheme) {
    const std::int64_t step = scheme.stepper().state().step - 1;
    if (step == window.first) scheme.stepper().save(state);
    if (step > window.first && step <= window.last) add_impulses(comm, scheme, estimate.impulse);
  };
  const std::vector<double> reduced = run_reduced(comm, scene, model, *model.motion, note_window);
  const std::vector<double> sum = run_full_window(comm, scene, model, window, state, estimate);
  for (double* impulse : {&estimate.impulse, &estimate.full_impulse}) {
    MPI_Allreduce(MPI_IN_PLACE, impulse, 1, MPI_DOUBLE, MPI_SUM, comm);
  }
  const auto first = static_cast<std::size_t>(window.first / stride) * channels;
  const Spectra full = spectra_of(comm, scene, model, *model.motion, {window.first, sum});
  const Spectra seen = spectra_of(comm, scene, model, *model.motion,
                                  {window.first, {reduced.data() + first, sum.size()}});
  const std::vector<char> moving = moving_channels(full);
  estimate.channels = distances(model, seen, full, moving);

  estimate.disturbance = least_disturbance;
  if (estimate.full_impulse > 0) {
    estimate.disturbance = std::clamp(std::abs(estimate.impulse / estimate.full_impulse - 1),
                                      least_disturbance, largest_disturbance);
  }
  const Spectra whole = spectra_of(comm, scene, model, *model.motion, {0, reduced});
  std::vector<std::vector<ChannelDistance>> spread;
  for (const double sign : {1.0, -1.0}) {
    const GroundMotion motion = model.motion->times(1 + sign * estimate.disturbance);
    const std::vector<double> other = run_reduced(comm, scene, model, motion, [](ModelScheme&) {});
    spread.push_back(
        distances(model, spectra_of(comm, scene, model, motion, {0, other}), whole, moving));
  }
  for (std::size_t b = 0; b < compared_bands.size(); ++b) {
    estimate.window[b] = rms_of_channels(estimate.channels, b);
    for (std::size_t c = 0; c < estimate.channels.size(); ++c) {
      const double both = joined(spread[0][c].rms[b], spread[1][c].rms[b]);
      spread[0][c].rms[b] = both < 0 ? both : both / std::sqrt(2.0);
      estimate.channels[c].rms[b] = joined(estimate.channels[c].rms[b], spread[0][c].rms[b]);
    }
    estimate.spread[b] = rms_of_channels(spread[0], b);
    estimate.rms[b] = rms_of_channels(estimate.channels, b);
  }
  estimate.wall_time = MPI_Wtime() - began;
  MPI_Bcast(&estimate.wall_time, 1, MPI_DOUBLE, 0, comm);
  return estimate;
}

std::string without_window(const Scene& scene) {
  const auto compared = [](double frequency) {
    return frequency >= compared_bands[0].low && frequency <= compared_bands[0].high;
  };
  if (std::ranges::count_if(scene.spectra.frequencies, compared) < 2) {
    return "fewer than two of -spectra_frequencies are between 1 and 400 Hz";
  }
  if (!scene.supports.empty()) return "supports move on their own";
  if (scene.motion_from_below) return "the motion comes from below";
  if (!scene.restart.empty()) return "the run before the checkpoint is not at hand";
  for (const Contact& contact : scene.contacts) {
    if (contact.sliding > 0) return "the faces of contact " + contact.name + " slide far";
    if (contact.filler || contact.is_elastic()) {
      return "contact " + contact.name + " has forces beside hard contact";
    }
  }
  bool any = false;
  for (const Structure& structure : scene.structures) {
    any = any || structure.modal || structure.mass_scaling > 0;
    if (structure.modal && !structure.modal->damping_ratios.empty()) {
      return "the damping ratios of modes of " + structure.name + " are none of its full order";
    }
    for (const Region& region : structure.regions) {
      const LawTrait in_modes = structure.modal ? has_element_law : LawTrait{};
      if ((follows_law | has_power | has_series | in_modes)(region)) {
        return "group " + region.group + " of " + structure.name + " is not linear";
      }
    }
  }
  return any ? "" : "no structure is reduced, nor its mass scaled";
}

}  // namespace pounding
