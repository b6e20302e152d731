#include "motion/oscillator_step.h"

#include "motion/oscillator_motion.h"

namespace pounding {
using namespace oscillator;

OscillatorStep oscillator_step(double theta, double damping_ratio) {
  const Oscillator o = make_oscillator(theta, damping_ratio);
  OscillatorStep result;
  const auto column = [&](std::size_t j, auto& matrix, const auto& step) {
    matrix[0][j] = step.derivative(0, 1);
    matrix[1][j] = step.derivative(1, 1);
  };
  const auto all = [&]<class Step>(const Step*) {
    column(0, result.state, Step(o, 1, 0, 0, 0));
    column(1, result.state, Step(o, 0, 1, 0, 0));
    column(0, result.load, Step(o, 0, 0, 1, 0));
    column(1, result.load, Step(o, 0, 0, 0, 1));
  };
  if (theta < series_limit) {
    all(static_cast<const StepSeries*>(nullptr));
  } else {
    all(static_cast<const StepClosedForm*>(nullptr));
  }
  return result;
}

std::vector<double> oscillator_history(std::span<const double> acceleration, double time_step,
                                       double frequency, double damping_ratio) {
  const double theta = 2 * std::numbers::pi * frequency * time_step;
  const Oscillator own = make_oscillator(theta, damping_ratio);
  const double square = time_step * time_step;
  double u = 0, v = 0;  // and h u'
  const auto go_to_end = [&](const auto& step) {
    u = step.derivative(0, 1);
    v = step.derivative(1, 1);
  };
  std::vector<double> history;
  history.reserve(acceleration.size());
  for (std::size_t i = 0; i < acceleration.size(); ++i) {
    // u'' + a = -2 xi omega u' - omega^2 u
    history.push_back(-(2 * damping_ratio * theta * v + theta * theta * u) / square);
    if (i + 1 == acceleration.size()) break;
    const double a0 = square * acceleration[i];
    const double a1 = square * acceleration[i + 1];
    if (theta < series_limit) {
      go_to_end(StepSeries(own, u, v, a0, a1));
    } else {
      go_to_end(StepClosedForm(own, u, v, a0, a1));
    }
  }
  return history;
}

}  // namespace pounding
