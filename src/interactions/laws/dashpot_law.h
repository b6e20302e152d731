#pragma once

#include "interactions/laws/link_law.h"

namespace pounding::interactions {

/// Law of a dashpot c at mid-step: with the elongations e_{n-1} and e_{n+1},
///
///     N_n = c (e_{n+1} - e_{n-1}) / (2 dt) = c (de/dt_{n+1/2} + de/dt_{n-1/2}) / 2
///
/// It holds no energy, and its loss N_n (e_{n+1} - e_{n-1}) / 2 is a square: no dashpot, however
/// strong, limits the time step.
class DashpotLaw final : public LinkLaw {
 public:
  /// `rate` c / (2 dt) [N/m].
  explicit DashpotLaw(double rate) : rate_(rate) {}

  double force(double before, double /*now*/, double after,
               std::span<const double> /*memory*/ = {}) const override {
    return rate_ * (after - before);
  }
  double solve(double before, double /*now*/, double free_after, double compliance,
               std::span<const double> /*memory*/ = {}) const override {
    return rate_ * (free_after - before) / (1 + compliance * rate_);
  }
  double energy(double /*now*/, double /*after*/,
                std::span<const double> /*memory*/ = {}) const override {
    return 0;
  }
  double tangent() const override { return 0; }
  double rate(double /*share*/ = 1) const override { return rate_; }
  bool is_idle(double /*now*/, std::span<const double> /*memory*/ = {}) const override {
    return false;
  }

 private:
  double rate_;
};

}  // namespace pounding::interactions
