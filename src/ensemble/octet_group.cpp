#include "ensemble/octet_group.h"

#include <algorithm>

#include "common/error.h"
#include "driver/floor_spectra.h"
#include "motion/response_spectrum.h"

namespace pounding {
namespace {

/// Steps between two questions whether to stop.
constexpr std::int64_t stop_interval = 2000;

}  // namespace

OctetGroup::OctetGroup(std::span<const MemberScene* const> members, const Scene& scene,
                       const EnsembleModel& shared, OctetRecorder& recorder)
    : scene_(scene), shared_(*shared.model), recorder_(recorder) {
  for (const MemberScene* member : members) models_.push_back(member_model(*member, shared));
  for (std::size_t s = 0; s < shared_.systems.size(); ++s) {
    std::vector<const LinearSystem*> systems;
    for (const Model& model : models_) systems.push_back(&model.systems[s]);
    octets_.emplace_back(systems, shared_.systems[s], shared_.time_step);
  }
  for (std::size_t lane = 0; lane < members.size(); ++lane) {
    runs_.push_back(
        std::make_unique<MemberRun>(*members[lane], shared, models_[lane], RunLane{octets_, lane}));
  }
  recorder_.restart(octets_);
}

bool OctetGroup::run(const std::function<bool()>& stopped) {
  for (std::int64_t n = 0; n <= shared_.steps; ++n) {
    if (n % stop_interval == 0 && stopped()) return false;
    step(n);
  }
  return true;
}

void OctetGroup::step(std::int64_t n) {
  const bool records = recorder_.due(n);
  if (records) recorder_.take_displacements(octets_);
  bool with_energies = false;
  for (std::size_t lane = 0; lane < runs_.size(); ++lane) {
    with_energies = runs_[lane]->open() || with_energies;
    for (std::size_t d = 0; d < 3; ++d) {
      acceleration_[d].set(lane, runs_[lane]->stepper().ground_acceleration()[d]);
    }
  }
  const double duration = runs_.front()->stepper().force_duration();
  for (OctetStep& octet : octets_) {
    octet.step(duration, acceleration_, runs_.front()->stepper().load_values(), with_energies);
  }
  for (failed_lane_ = 0; failed_lane_ < runs_.size(); ++failed_lane_) runs_[failed_lane_]->close();
  std::array<Octet, 3> gained = acceleration_;
  for (Octet& value : gained) value = value * all_octet(duration);
  recorder_.add_step(gained);
  if (records) recorder_.record(octets_);
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
