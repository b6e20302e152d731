#include <algorithm>

#include "dynamics/link_step.h"
#include "interactions/laws/dashpot_law.h"

namespace pounding {

bool LinkStep::are_dashpots(const LinearSystem& system) const {
  if (!system.generalised || !carried_.empty() || links_.empty()) return false;
  const bool driven = std::ranges::any_of(links_, [](const Link& link) {
    return link.incident != Vector3{0, 0, 0};
  });
  return !driven &&
         std::ranges::all_of(laws_, [](const std::unique_ptr<interactions::LinkLaw>& law) {
           return dynamic_cast<const interactions::DashpotLaw*>(law.get()) != nullptr;
         });
}

void LinkStep::make_modes(const LinearSystem& system) {
  const std::size_t size = trace_.dofs().size();
  std::vector<double> rows(links_.size() * size, 0.0);
  std::vector<double> strengths;
  for (std::size_t b = 0; b < links_.size(); ++b) {
    for (std::size_t k = 0; k < links_[b].place.size(); ++k) {
      if (links_[b].place[k] < 0) continue;
      trace_.add_force(static_cast<std::size_t>(links_[b].place[k]), links_[b].weight[k],
                       {&rows[b * size], size});
    }
    strengths.push_back(2 * time_step_ * laws_[b]->rate());
  }
  modes_ = std::make_unique<DashpotModes>(system, rows, strengths, time_step_);
}

double LinkStep::force(std::size_t link) const {
  if (!modes_) return force_[link];
  double rate = 0;  // b . (v- + v+)
  for (std::size_t k = 0; k < links_[link].place.size(); ++k) {
    if (links_[link].place[k] < 0) continue;
    const auto row = trace_.row(static_cast<std::size_t>(links_[link].place[k]));
    for (std::size_t i = 0; i < row.size(); ++i) {
      rate += links_[link].weight[k] * row[i] * modes_->sums()[i];
    }
  }
  return laws_[link]->rate() * time_step_ * rate;
}

void LinkStep::brake(bool first) {
  trace_.restrict_to_dofs(state_.velocity.data(), velocity_.data());
  modes_->brake(first ? 0.5 : 1, held_.velocity, velocity_);
  step_.correct(trace_.dofs(), held_, velocity_);
}

void LinkStep::finish_modes(StepSums& sums) {
  sums.link_loss += modes_->loss(held_.velocity, state_.velocity);
  if (records_.empty()) return;
  for (const std::size_t b : records_.links()) force_[b] = force(b);
  measure(held_.velocity, {}, before_);
  measure(state_.velocity, {}, after_);
  for (std::size_t b = 0; b < links_.size(); ++b) {
    before_[b] *= -time_step_;
    after_[b] *= time_step_;
  }
  note_records();
}

}  // namespace pounding
