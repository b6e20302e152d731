#include "laws/yield_law.h"

namespace pounding::interactions {

void YieldLaw::yield(double now, double kept, std::span<double> memory) const {
  memory[1] = kept < 1 ? now - kept * (now - memory[0]) : memory[0];
}

double YieldLaw::force(double /*before*/, double now, double /*after*/, Memory memory) const {
  return after_ * now + elastic_ * (now - memory[1]);
}

double YieldLaw::energy(double now, double after, Memory memory) const {
  return (after_ * now * after + elastic_ * (now - memory[0]) * (after - memory[0])) / 2;
}

void YieldLaw::remember(double /*before*/, double /*now*/, double /*after*/, double /*share*/,
                        std::span<double> memory) const {
  memory[0] = memory[1];
}

}  // namespace pounding::interactions
