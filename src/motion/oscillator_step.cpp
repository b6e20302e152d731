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

}  // namespace pounding
