#include "fidelity/window_spectra.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "common/parallel.h"
#include "fidelity/probe_means.h"
#include "fidelity/stepped_window.h"
#include "observers/observed_run.h"

namespace pounding {

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

std::vector<double> run_reduced(MPI_Comm comm, const Scene& scene, const Model& model,
                                const GroundMotion& motion,
                                const std::function<void(ModelScheme&)>& after_step) {
  Profile profile;
  ModelScheme::Parts parts = scheme_parts(comm, scene, model, model.meshes, profile);
  parts.motion = &motion;
  ModelScheme scheme(std::move(parts));
  ProbeMeans means(model.probes, model.systems, model.meshes);
  const int stride = record_stride(scene, model);
  std::vector<double> records;
  std::vector<double> now(means.channels());
  for (std::int64_t n = 0; n <= model.steps; ++n) {
    scheme.stepper().step(false, false);
    after_step(scheme);
    if (n % stride != 0) continue;
    means.velocities(scheme.stepper().state(), now);
    records.insert(records.end(), now.begin(), now.end());
  }
  reduce_over_ranks(comm, MPI_SUM, records);
  return records;
}

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

SeenWindow see_window(MPI_Comm comm, const Scene& scene, const Model& model, Window window) {
  SeenWindow seen;
  const auto note = [&](ModelScheme& scheme) {
    const std::int64_t step = scheme.stepper().state().step - 1;
    if (step == window.first) scheme.stepper().keep(StateKeeper::to(seen.state));
    if (step > window.first && step <= window.last) add_impulses(scheme, seen.impulse);
  };
  seen.velocities = run_reduced(comm, scene, model, *model.motion, note);
  reduce_over_ranks(comm, MPI_SUM, seen.impulse);
  seen.window = std::move(window);
  return seen;
}

double order_of(double change, double next) {
  constexpr double least = 1;
  return next > 0 ? std::clamp(std::log2(change / next), least, 2.0) : 2.0;
}

}  // namespace pounding
