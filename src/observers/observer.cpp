#include "observers/observer.h"

#include <algorithm>

namespace pounding {

void Observers::start(const CdLagrange& stepper, const SavedState* continued) {
  for (const auto& observer : list_) observer->start(stepper, continued);
  for (const auto& observer : list_) {
    if (observer->follows()) followers_.push_back(observer.get());
    next_.push_back(observer->next_due(stepper.state().step));
  }
  due_.reserve(list_.size());
  earliest_ = std::ranges::min(next_);
}

const ImpactCatalogue& Observers::impacts() const {
  return *(*std::ranges::find_if(list_, [](auto& one) {
            return one->impacts() != nullptr;
          }))->impacts();
}

const Recorder& Observers::history() const {
  return *(*std::ranges::find_if(list_, [](auto& one) {
            return one->history() != nullptr;
          }))->history();
}

StepNeeds Observers::begin_due(const CdLagrange& stepper) {
  StepNeeds all;
  for (std::size_t i = 0; i < list_.size(); ++i) {
    if (next_[i] != stepper.state().step) continue;
    due_.push_back(i);
    const ScopedTimer timer(profile_, list_[i]->phase());
    const StepNeeds needs = list_[i]->begin(stepper);
    all.gaps = all.gaps || needs.gaps;
    all.energies = all.energies || needs.energies;
    all.forces = all.forces || needs.forces;
  }
  return all;
}

void Observers::after(const CdLagrange& stepper) {
  {
    const ScopedTimer timer(profile_, Phase::output);
    for (Observer* const observer : followers_) observer->follow(stepper);
  }
  if (due_.empty()) return;
  for (const std::size_t i : due_) {
    const ScopedTimer timer(profile_, list_[i]->phase());
    list_[i]->observe(stepper);
    next_[i] = list_[i]->next_due(stepper.state().step);
  }
  due_.clear();
  earliest_ = std::ranges::min(next_);
}

}  // namespace pounding
