#include "fidelity/full_order_window.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "common/facts.h"
#include "common/parallel.h"
#include "driver/build_model.h"
#include "driver/time_loop.h"
#include "fidelity/probe_means.h"
#include "interactions/frictional_contact.h"
#include "interactions/interface_rows.h"
#include "model/solver.h"
#include "motion/response_spectrum.h"
#include "observers/observed_run.h"

namespace pounding {
namespace {

/// Time over which the ground's motion sets in at full order [s].
constexpr double fade_in = 0.1;

/// Part of the window before the impact that it is made for, the fade-in being a part of that [s].
constexpr double before_impact = 0.15;

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

/// A part of a run, by steps that make records.
struct Window {
  std::int64_t first = 0;  ///< the last step before it
  std::int64_t last = 0;
  std::string reason{};
};

/// The time that the window is about, and why.
std::pair<double, std::string> decisive_time(const Scene& scene, const ImpactCatalogue& impacts,
                                             const Recorder& recorder) {
  const auto& list = impacts.impacts();
  if (!list.empty()) {
    const Impact& impact = *std::ranges::max_element(list, {}, &Impact::impulse);
    return {impact.start,
            sentence("around the largest impulse, {:.4g} N s of {} at {:.4g} s",
                     {impact.impulse, scene.contacts[impact.contact].name, impact.start})};
  }
  double largest = 0;
  double time = 0;
  for (std::size_t channel = 0; channel < 3 * recorder.probes().size(); ++channel) {
    const std::vector<double> values = recorder.acceleration(channel);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (std::abs(values[i]) <= largest) continue;
      largest = std::abs(values[i]);
      time = static_cast<double>(i) * recorder.interval();
    }
  }
  return {time, "around the largest acceleration of a probe; nothing was hit"};
}

Window place_window(MPI_Comm comm, const Scene& scene, const Model& model,
                    const ImpactCatalogue& impacts, const Recorder& recorder, double length) {
  Window window;
  std::vector<std::int64_t> steps(2);
  on_rank0(comm, [&] {
    auto [time, reason] = decisive_time(scene, impacts, recorder);
    window.reason = std::move(reason);
    const std::int64_t stride = record_stride(scene, model);
    const std::int64_t end = model.steps / stride;
    const double interval = recorder.interval();
    const std::int64_t records = std::clamp<std::int64_t>(std::llround(length / interval),
                                                          std::min<std::int64_t>(2, end), end);
    const std::int64_t begin = std::llround((time - before_impact) / interval);
    const std::int64_t first = std::clamp<std::int64_t>(begin, 0, end - records);
    steps = {first * stride, (first + records) * stride};
  });
  broadcast_array(comm, steps);
  window.first = steps[0];
  window.last = steps[1];
  return window;
}

/// Sum of the impulses of a run, on the root of its contacts.
void add_impulses(MPI_Comm comm, Solver& solver, double& sum) {
  if (solver.contact() == nullptr || solver.contact()->root() != rank_of(comm)) return;
  if (!solver.rows_act()) return;
  for (const double impulse : solver.row_actions().impulses) sum += impulse;
}

/// Motion of the reduced structures by themselves from the beginning of the window on.
class Inherited {
 public:
  Inherited(MPI_Comm comm, const Scene& scene, const Model& model, const Window& window,
            const SavedState& state, Profile& profile)
      : comm_(comm),
        model_(model),
        stride_(record_stride(scene, model)),
        first_(window.first),
        motion_(model.motion->part(GroundMotion::Part::leaves, start(), start() + fade_in)),
        none_{{}, {}, {}, model.interface.extents, model.interface.model_size, {}, {}},
        solver_(parts(scene, profile)),
        means_(model.probes, model.systems, model.meshes),
        rows_(comm, interactions::with_friction_rows(model.interface.constraints), model.systems,
              model.meshes) {
    solver_.stepper().load(state);
    take_places(-model.time_step);
    take_places(0);
    record();
  }

  /// When the window begins: the next step's time [s].
  double start() const { return static_cast<double>(first_ + 1) * model_.time_step; }
  std::size_t dofs() const { return rows_.dofs(); }
  /// Displacements of the interface's places at a time after the start [m].
  void places(double time, std::vector<double>& result) {
    const double steps = time / model_.time_step;
    const auto whole = static_cast<std::int64_t>(std::floor(steps));
    while (front_ + static_cast<std::int64_t>(places_.size()) < whole + 3) step();
    for (; front_ < whole - 1; ++front_) places_.pop_front();
    // Cubic through the two steps before and the two after.
    const double s = steps - static_cast<double>(whole);
    const double weights[] = {-s * (s - 1) * (s - 2) / 6, (s + 1) * (s - 1) * (s - 2) / 2,
                              -(s + 1) * s * (s - 2) / 2, (s + 1) * s * (s - 1) / 6};
    std::ranges::fill(result, 0.0);
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t i = 0; i < result.size(); ++i) result[i] += weights[k] * places_[k][i];
    }
  }
  /// Makes the records until step `last` of the run.
  void finish(std::int64_t last) {
    while (solver_.stepper().state().step <= last) step();
  }
  /// Velocities of the channels in every record from the window's first step on, this rank's part.
  const std::vector<double>& records() const { return records_; }

 private:
  Solver::Parts parts(const Scene& scene, Profile& profile) const {
    Solver::Parts parts = solver_parts(comm_, scene, model_, model_.meshes, profile);
    parts.interface = &none_;
    parts.motion = &motion_;
    return parts;
  }
  void step() {
    CdLagrange& stepper = solver_.stepper();
    stepper.step(false, false);
    if ((stepper.state().step - 1) % stride_ == 0) record();
    take_places(0);
  }
  /// The places of the state, and how its velocity moves them for a while [s].
  void take_places(double duration) {
    std::vector<double> values(rows_.dofs());
    if (rows_.member()) {
      for (std::size_t s = 0; s < model_.systems.size(); ++s) {
        const StructureState& state = solver_.stepper().state().structures[s];
        std::vector<double> owned = state.displacement;
        for (std::size_t i = 0; i < owned.size(); ++i) owned[i] += duration * state.velocity[i];
        rows_.set(s, 0, 1, owned.data(), {});
      }
      rows_.gather(1, values);
    }
    if (rows_.dofs() > 0) broadcast_array(comm_, values, rows_.root());
    places_.push_back(std::move(values));
  }
  void record() {
    const std::size_t before = records_.size();
    records_.resize(before + means_.channels());
    means_.velocities(solver_.stepper().state(), {records_.data() + before, means_.channels()});
  }

  MPI_Comm comm_;
  const Model& model_;
  int stride_;
  std::int64_t first_;
  GroundMotion motion_;
  interactions::Interface none_;
  Solver solver_;
  ProbeMeans means_;
  interactions::InterfaceRows rows_;
  std::deque<std::vector<double>> places_;
  std::int64_t front_ = -1;  ///< step after the start of the first of `places_`
  std::vector<double> records_;
};

/// Velocities of the channels at full order at the times of the records, this rank's part.
std::vector<double> run_window(const Window& window, Inherited& inherited, int stride,
                               double reduced_step, double step, ProbeMeans& means, Solver& solver,
                               const std::function<void()>& after_step) {
  const std::size_t channels = means.channels();
  interactions::ContactProblem::Carried carried;
  std::vector<double> next(inherited.dofs());
  carried.displacement.resize(next.size());
  carried.velocity.resize(next.size());
  inherited.places(0, carried.displacement);
  if (solver.contact() != nullptr) solver.contact()->carry(carried);
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
    solver.stepper().step(true, false);
    after_step();
    carried.displacement = next;
    means.velocities(solver.stepper().state(), now);
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
                                const std::function<void(Solver&)>& after_step) {
  Profile profile;
  Solver::Parts parts = solver_parts(comm, scene, model, model.meshes, profile);
  parts.motion = &motion;
  Solver solver(std::move(parts));
  ProbeMeans means(model.probes, model.systems, model.meshes);
  const int stride = record_stride(scene, model);
  std::vector<double> velocities;
  std::vector<double> now(means.channels());
  for (std::int64_t n = 0; n <= model.steps; ++n) {
    solver.stepper().step(false, false);
    after_step(solver);
    if (n % stride != 0) continue;
    means.velocities(solver.stepper().state(), now);
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
  Inherited inherited(comm, scene, model, window, state, profile);
  Scene full_scene = at_full_order(scene, model);
  const std::vector<double> ones(scene.structures.size(), 1.0);
  Model full = build_model(comm, full_scene, ones, profile);
  set_free(full);
  const double start = inherited.start();
  const GroundMotion driving =
      model.motion->part(GroundMotion::Part::sets_in, start, start + fade_in).counted_from(start);
  Solver::Parts parts = solver_parts(comm, full_scene, full, full.meshes, profile);
  parts.interface = &model.interface;
  parts.motion = &driving;
  parts.loads = nullptr;
  parts.carried = true;
  Solver solver(std::move(parts));
  ProbeMeans means(full.probes, full.systems, full.meshes);
  MPI_Barrier(comm);
  const double began = MPI_Wtime();
  std::vector<double> velocities =
      run_window(window, inherited, record_stride(scene, model), model.time_step, full.time_step,
                 means, solver, [&] { add_impulses(comm, solver, estimate.full_impulse); });
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
  const auto note_window = [&](Solver& solver) {
    const std::int64_t step = solver.stepper().state().step - 1;
    if (step == window.first) solver.stepper().save(state);
    if (step > window.first && step <= window.last) add_impulses(comm, solver, estimate.impulse);
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
    const std::vector<double> other = run_reduced(comm, scene, model, motion, [](Solver&) {});
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
      if (follows_law(region) || yields_by_links(region) || region.nonlinear.has_series() ||
          region.nonlinear.dashpot_exponent != 1) {
        return "group " + region.group + " of " + structure.name + " is not linear";
      }
    }
  }
  return any ? "" : "no structure is reduced, nor its mass scaled";
}

}  // namespace pounding
