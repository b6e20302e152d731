#include "fidelity/window_place.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "common/facts.h"
#include "common/parallel.h"
#include "observers/observed_run.h"

namespace pounding {
namespace {

/// Part of the window before the impact that it is made for, the fade-in being a part of that [s],
/// and of a short window at most.
constexpr double before_impact = 0.15;
constexpr double most_before = 0.75;

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

}  // namespace

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
    const std::int64_t begin =
        std::llround(time / interval - std::min(before_impact / interval,
                                                most_before * static_cast<double>(records)));
    const std::int64_t first = std::clamp<std::int64_t>(begin, 0, end - records);
    steps = {first * stride, (first + records) * stride};
  });
  broadcast_array(comm, steps);
  window.first = steps[0];
  window.last = steps[1];
  return window;
}

}  // namespace pounding
