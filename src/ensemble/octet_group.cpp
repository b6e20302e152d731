#include "ensemble/octet_group.h"

#include <algorithm>

#include "common/error.h"
#include "common/row_products.h"
#include "driver/field_plan.h"
#include "driver/stated_peak.h"
#include "motion/response_spectrum.h"

namespace pounding {
namespace {

/// Steps between two questions whether to stop.
constexpr std::int64_t stop_interval = 2000;

}  // namespace

OctetGroup::OctetGroup(std::span<const MemberScene* const> members, const Scene& scene,
                       const EnsembleModel& shared, OctetRecorder& recorder)
    : scene_(scene),
      shared_(*shared.model),
      recorder_(recorder),
      gap_stride_(gap_stride(scene, shared_)) {
  for (std::size_t lane = 0; lane < members.size(); ++lane) {
    runs_.push_back(std::make_unique<MemberRun>(*members[lane], shared, lane));
  }
  for (std::size_t s = 0; s < shared_.systems.size(); ++s) {
    std::vector<const LinearSystem*> systems;
    for (const auto& run : runs_) systems.push_back(&run->system(s));
    steps_.emplace_back(systems, shared_.time_step);
    states_.emplace_back(steps_[s].coordinates(), steps_[s].filters());
    for (std::size_t lane = 0; lane < runs_.size(); ++lane) {
      states_[s].put(lane, runs_[lane]->initial().structures[s]);
    }
    places_.emplace_back(runs_[0]->interface_rows(s).size() / steps_[s].coordinates());
  }
  recorder_.restart(states_);
}

bool OctetGroup::run(const std::function<bool()>& stopped) {
  for (std::int64_t n = 0; n <= shared_.steps; ++n) {
    if (n % stop_interval == 0 && stopped()) return false;
    step(n);
  }
  return true;
}

void OctetGroup::step(std::int64_t n) {
  const bool ledger = n > 0 && (n % scene_.energy_interval == 0 || n == shared_.steps);
  const bool records = recorder_.due(n);
  const double duration = n == 0 ? shared_.time_step / 2 : shared_.time_step;
  const double time = static_cast<double>(n) * shared_.time_step;
  if (records) recorder_.take_displacements(states_);
  for (std::size_t lane = 0; lane < runs_.size(); ++lane) {
    const std::array<double, 3>& ground = runs_[lane]->begin(time);
    for (std::size_t d = 0; d < 3; ++d) acceleration_[d].set(lane, ground[d]);
  }
  std::span<const std::vector<Octet>> places;
  if (records && n % gap_stride_ == 0) {
    find_places();
    places = places_;
  }
  for (auto& run : runs_) run->look(n, places, steps_, states_);
  const bool with_energies = ledger || runs_[0]->needs_energies();
  for (std::size_t s = 0; s < steps_.size(); ++s) {
    steps_[s].step(duration, acceleration_, with_energies, states_[s]);
  }
  for (auto& run : runs_) run->resolve(steps_, states_);
  for (auto& run : runs_) run->close(time, duration, records, steps_);
  std::array<Octet, 3> gained = acceleration_;
  for (Octet& value : gained) value = value * all_octet(duration);
  recorder_.add_step(gained);
  if (records) recorder_.record(states_);
  if (ledger) close_lines(n);
}

void OctetGroup::find_places() {
  for (std::size_t s = 0; s < places_.size(); ++s) {
    const std::span<const double> rows = runs_[0]->interface_rows(s);
    multiply_rows(rows.data(), places_[s].size(), steps_[s].coordinates(),
                  states_[s].displacement.data(), places_[s].data());
  }
}

void OctetGroup::close_lines(std::int64_t n) {
  for (failed_lane_ = 0; failed_lane_ < runs_.size(); ++failed_lane_) {
    runs_[failed_lane_]->close_ledger(n, states_);
  }
}

MemberResult OctetGroup::result(std::size_t lane) {
  MemberResult result;
  runs_[lane]->fill(result);
  const double frequency = stated_frequency(scene_, recorder_.interval());
  for (std::size_t c = 0; c < recorder_.channels(); ++c) {
    const std::span<const double> history = recorder_.acceleration(c, lane);
    const std::span<const double> counted =
        history.subspan(std::min(recorder_.first(), history.size()));
    for (const auto& spectrum :
         response_spectra(counted, recorder_.interval(), scene_.spectra.frequencies,
                          scene_.spectra.damping_ratios, AfterRecord::ignored)) {
      for (const SpectrumPoint& point : spectrum) {
        result.spectra.push_back(point.pseudo_acceleration);
      }
    }
    result.displacement.push_back(recorder_.largest_displacement(c, lane));
    result.acceleration.push_back(
        stated_peak(history, recorder_.interval(), frequency, recorder_.first()));
  }
  return result;
}

}  // namespace pounding
