#include "fidelity/full_order_window.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "fidelity/mesh_error.h"
#include "fidelity/stepped_window.h"
#include "fidelity/window_spectra.h"
#include "observers/observed_run.h"
#include "scene/law_kinds.h"

namespace pounding {
namespace {

/// Part by which the ground's motion is changed at least and at most.
constexpr double least_disturbance = 1e-3;
constexpr double largest_disturbance = 0.2;

/// Part of the error of the reduction from which on that of the step is looked at more closely.
constexpr double may_govern = 0.5;
/// Distance of spectra that is none.
constexpr double round_off = 1e-9;

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

/// Place, impulses, costs and disturbance of a window go to its estimate.
void compare_window(const SeenWindow& seen, const SteppedWindow& stepped,
                    const SteppedWindow::Motion& motion, const Scene& scene,
                    FidelityEstimate& estimate) {
  estimate.reason = seen.window.reason;
  estimate.impulse = seen.impulse;
  estimate.full_impulse = motion.impulse;
  estimate.start = stepped.start();
  estimate.end = stepped.end();
  estimate.full_dofs = stepped.full().dofs();
  estimate.time_step = stepped.full().time_step;
  estimate.full_run_time = motion.seconds * scene.end_time / (estimate.end - estimate.start);
  offer_scaled_mass(stepped.full(), estimate);
  estimate.disturbance = least_disturbance;
  if (estimate.full_impulse > 0) {
    estimate.disturbance = std::clamp(std::abs(estimate.impulse / estimate.full_impulse - 1),
                                      least_disturbance, largest_disturbance);
  }
}

/// Adds the spread of the reduced run to the distances in the window; that spread. Collective.
std::vector<ChannelDistance> add_spread(MPI_Comm comm, const Scene& scene, const Model& model,
                                        const SeenWindow& seen, std::span<const char> moving,
                                        FidelityEstimate& estimate) {
  const Spectra whole = spectra_of(comm, scene, model, *model.motion, {0, seen.velocities});
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
  return std::move(spread[0]);
}

/// The error of a step of full order, by half of it and, where that may be the largest error, by a
/// quarter, and by as much of the `spread` as the impulses of the half differ. Collective.
ErrorPart step_error(MPI_Comm comm, const Scene& scene, const Model& model,
                     const SteppedWindow& stepped, const Spectra& full, std::int64_t first,
                     std::span<const char> moving, std::span<const ChannelDistance> spread,
                     const FidelityEstimate& estimate) {
  const auto spectra_of_motion = [&](const SteppedWindow::Motion& motion) {
    return spectra_of(comm, scene, model, *model.motion, {first, motion.velocities});
  };
  const SteppedWindow::Motion finer = stepped.run(2);
  const Spectra half = spectra_of_motion(finer);
  ErrorPart part{"step", 1, false, distances(model, full, half, moving), {}};
  const double change = rms_of_channels(part.channels, 0);
  if (change > round_off && change <= far_apart &&
      part.extrapolation() * change > may_govern * estimate.rms[0]) {
    const Spectra quarter = spectra_of_motion(stepped.run(4));
    part.order = order_of(change, rms_of_channels(distances(model, half, quarter, moving), 0));
    part.measured = true;
  }
  if (estimate.full_impulse > 0) {
    const double share = std::abs(finer.impulse / estimate.full_impulse - 1) / estimate.disturbance;
    for (std::size_t c = 0; c < part.channels.size(); ++c) {
      for (std::size_t b = 0; b < compared_bands.size(); ++b) {
        double& rms = part.channels[c].rms[b];
        rms = joined(rms, share * spread[c].rms[b]);
      }
    }
  }
  part.extrapolate();
  return part;
}

}  // namespace

FidelityEstimate estimate_fidelity(MPI_Comm comm, const Scene& scene, const Model& model,
                                   const ImpactCatalogue& impacts, const Recorder& recorder,
                                   double length, bool with_mesh, const ErrorPart* mesh) {
  const double began = MPI_Wtime();
  FidelityEstimate estimate;
  const SeenWindow seen =
      see_window(comm, scene, model, place_window(comm, scene, model, impacts, recorder, length));
  auto stepped = std::make_unique<const SteppedWindow>(comm, scene, model, seen.window, seen.state);
  const SteppedWindow::Motion motion = stepped->run(1);
  const std::int64_t first = seen.window.first;
  const auto spectra_in_window = [&](std::span<const double> records) {
    return spectra_of(comm, scene, model, *model.motion, {first, records});
  };
  const Spectra full = spectra_in_window(motion.velocities);
  const std::int64_t skipped = first / record_stride(scene, model);
  const std::size_t channels = 3 * model.probes.size();
  const Spectra reduced = spectra_in_window(
      std::span(seen.velocities)
          .subspan(static_cast<std::size_t>(skipped) * channels, motion.velocities.size()));
  const std::vector<char> moving = moving_channels(full);
  estimate.channels = distances(model, reduced, full, moving);
  compare_window(seen, *stepped, motion, scene, estimate);
  const std::vector<ChannelDistance> spread =
      add_spread(comm, scene, model, seen, moving, estimate);
  estimate.parts.push_back(
      step_error(comm, scene, model, *stepped, full, first, moving, spread, estimate));
  stepped.reset();  // the mesh that is split next takes far more
  estimate.run_time_step = model.time_step;
  if (mesh != nullptr && std::ranges::equal(mesh->channels, estimate.channels, {},
                                            &ChannelDistance::name, &ChannelDistance::name)) {
    estimate.parts.push_back(*mesh);
  } else if (with_mesh) {
    add_mesh_error(comm, scene, model, seen, full, moving, motion.seconds, estimate);
  } else {
    estimate.mesh = "not asked for (-fidelity_mesh)";
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
      if ((follows_law | has_power | has_series | has_element_law)(region)) {
        return "group " + region.group + " of " + structure.name + " is not linear";
      }
    }
  }
  return any ? "" : "no structure is reduced, nor its mass scaled";
}

}  // namespace pounding
