#include "observers/force_window.h"

#include <algorithm>
#include <cmath>

namespace pounding {

ForceWindow::ForceWindow(double length, double time_step) : length_(length) {
  constexpr double most = 1e6;  // more would only be allocated when they come
  steps_.reserve(2 * static_cast<std::size_t>(std::min(most, std::ceil(length / time_step) + 3)));
}

double ForceWindow::at(const Step& step, double time) {
  const double share = (time - step.start) / (step.end - step.start);
  return step.before + std::clamp(share, 0.0, 1.0) * (step.after - step.before);
}

void ForceWindow::add(double start, double end, double impulse) {
  const bool any = first_ < steps_.size();
  const double last = any ? steps_.back().end : start;
  const double before = any ? steps_.back().after : 0.0;
  const Step step{start, end, before, before + impulse};
  // The impulse over time is a polygon, so that the largest rise within a length begins or ends
  // where a step does. Times that begin with a step and end in this one, or since the last:
  double most = 0;
  for (std::size_t i = first_; i < steps_.size() && steps_[i].start + length_ <= end; ++i) {
    if (steps_[i].start + length_ <= last) continue;
    most = std::max(most, at(step, steps_[i].start + length_) - steps_[i].before);
  }
  while (first_ < steps_.size() && steps_[first_].end <= end - length_) ++first_;
  if (first_ == steps_.size() || steps_.size() == steps_.capacity()) {
    steps_.erase(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(first_));
    first_ = 0;
  }
  steps_.push_back(step);
  most = std::max(most, step.after - at(steps_[first_], end - length_));  // that end with it
  largest_ = std::max(largest_, most / length_);
}

void ForceWindow::reset() {
  steps_.clear();
  first_ = 0;
  largest_ = 0;
}

void ForceWindow::keep(const std::string& name, const StateKeeper& state) {
  std::vector<Step> rows{{largest_, 0, 0, 0}};
  rows.insert(rows.end(), steps_.begin() + static_cast<std::ptrdiff_t>(first_), steps_.end());
  state.list(name, rows, [](auto& step, const auto& take) {
    take(step.start, step.end, step.before, step.after);
  });
  if (rows.empty()) state.state().refuse_values(name);
  largest_ = rows[0].start;
  first_ = 0;
  steps_.assign(rows.begin() + 1, rows.end());
}

}  // namespace pounding
