#include "dynamics/tension_bar_step.h"

#include <algorithm>
#include <cmath>

namespace pounding {
namespace {

constexpr int most_sweeps = 1000;
constexpr double converged = 1e-15;  ///< change of a tension over the largest

}  // namespace

TensionBarStep::TensionBarStep(const LinearSystem& system, const StructureState& state,
                               StructureStep& step, double time_step)
    : state_(state),
      step_(step),
      time_step_(time_step),
      bars_(system.tension_bars->bars()),
      trace_(system.tension_bars->trace()),
      held_(trace_.dofs().size()),
      before_(bars_.size(), 0.0),
      now_(bars_.size(), 0.0),
      after_(bars_.size(), 0.0),
      free_after_(bars_.size(), 0.0),
      tension_(bars_.size(), 0.0),
      field_(trace_.known().size(), 0.0),
      velocity_(trace_.dofs().size(), 0.0) {
  for (const TensionBar& bar : bars_) {
    laws_.push_back({bar.stiffness, bar.damping / (2 * time_step)});
  }
  find_couplings();
}

void TensionBarStep::find_couplings() {
  std::vector<double> unit(field_.size(), 0.0);
  const std::vector<double> at_rest(velocity_.size(), 0.0);
  std::vector<double> all(state_.velocity.size(), 0.0);
  for (const TensionBar& bar : bars_) {
    std::fill(unit.begin(), unit.end(), 0.0);
    for (std::size_t i = 0; i < bar.place.size(); ++i) {
      if (bar.place[i] >= 0) {
        unit[static_cast<std::size_t>(bar.place[i])] += i < 3 ? -bar.axis[i] : bar.axis[i - 3];
      }
    }
    velocity_ = at_rest;
    trace_.add_impulse(unit.data(), velocity_.data());
    for (std::size_t k = 0; k < velocity_.size(); ++k) {
      all[static_cast<std::size_t>(trace_.dofs()[k])] = velocity_[k];
    }
    measure(all, free_after_);
    std::vector<Coupling>& coupled = coupled_.emplace_back();
    const std::size_t self = coupled_.size() - 1;
    coupled.push_back({self, time_step_ * time_step_ * std::max(0.0, free_after_[self])});
    for (std::size_t other = 0; other < bars_.size(); ++other) {
      if (other != self && free_after_[other] != 0) {
        coupled.push_back({other, time_step_ * time_step_ * free_after_[other]});
      }
    }
  }
}

void TensionBarStep::measure(const std::vector<double>& owned, std::vector<double>& elongations) {
  trace_.apply(owned.data(), field_.data(), 1);
  for (std::size_t b = 0; b < bars_.size(); ++b) {
    elongations[b] = bars_[b].elongation(field_);
  }
}

void TensionBarStep::begin() {
  step_.remember(trace_.dofs(), held_);
  measure(state_.displacement, now_);
  measure(state_.velocity, before_);
  for (std::size_t b = 0; b < bars_.size(); ++b) {
    before_[b] = now_[b] - time_step_ * before_[b];
  }
}

double TensionBarStep::sweep() {
  double change = 0;
  for (std::size_t b = 0; b < bars_.size(); ++b) {
    double free_after = free_after_[b];
    for (std::size_t k = 1; k < coupled_[b].size(); ++k) {
      free_after -= coupled_[b][k].compliance * tension_[coupled_[b][k].bar];
    }
    const double tension =
        laws_[b].solve(before_[b], now_[b], free_after, coupled_[b][0].compliance);
    change = std::max(change, std::abs(tension - tension_[b]));
    tension_[b] = tension;
  }
  return change;
}

void TensionBarStep::pull(bool first) {
  std::fill(tension_.begin(), tension_.end(), 0.0);
  if (std::ranges::all_of(now_, [](double e) { return e <= 0; })) {
    return;
  }
  if (first) {
    for (std::size_t b = 0; b < bars_.size(); ++b) {
      tension_[b] = laws_[b].tension(before_[b], now_[b], 2 * now_[b] - before_[b]);
    }
  } else {
    measure(state_.displacement, free_after_);
    for (int i = 0; i < most_sweeps; ++i) {
      const double change = sweep();
      if (change <= converged * *std::ranges::max_element(tension_)) {
        break;
      }
    }
  }
  const double duration = first ? time_step_ / 2 : time_step_;
  std::fill(field_.begin(), field_.end(), 0.0);
  for (std::size_t b = 0; b < bars_.size(); ++b) {
    for (std::size_t i = 0; i < bars_[b].place.size(); ++i) {
      if (bars_[b].place[i] >= 0) {
        field_[static_cast<std::size_t>(bars_[b].place[i])] +=
            (i < 3 ? bars_[b].axis[i] : -bars_[b].axis[i - 3]) * duration * tension_[b];
      }
    }
  }
  trace_.restrict_to_dofs(state_.velocity.data(), velocity_.data());
  trace_.add_impulse(field_.data(), velocity_.data());
  step_.correct(trace_.dofs(), held_, velocity_);
}

void TensionBarStep::finish(StepSums& sums) {
  measure(state_.displacement, after_);
  for (std::size_t b = 0; b < bars_.size(); ++b) {
    const double held = laws_[b].energy(before_[b], now_[b]);
    sums.bar_energy_before += held;
    sums.bar_loss +=
        tension_[b] * (after_[b] - before_[b]) / 2 - (laws_[b].energy(now_[b], after_[b]) - held);
  }
}

}  // namespace pounding
