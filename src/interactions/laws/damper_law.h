#pragma once

#include "interactions/laws/link_law.h"

namespace pounding::interactions {

/// Law of a viscous damper of a power a of its rate, at mid-step:
///
///     N_n = c |r|^a sign r,      r = (e_{n+1} - e_{n-1}) / (2 dt)
///
/// It holds no energy, and its loss N_n r is never less than nothing: like a dashpot (a = 1) it
/// does not limit the time step, however strong it is.
class DamperLaw final : public LinkLaw {
 public:
  /// `strength` c [N (s/m)^a], `exponent` a > 0, `time_step` [s].
  DamperLaw(double strength, double exponent, double time_step);

  double force(double before, double now, double after,
               std::span<const double> memory = {}) const override;
  /// Force by Newton's iteration on a convex function, from the side where it never overshoots.
  double solve(double before, double now, double free_after, double compliance,
               std::span<const double> memory = {}) const override;
  double energy(double /*now*/, double /*after*/,
                std::span<const double> /*memory*/ = {}) const override {
    return 0;
  }
  double tangent() const override { return 0; }
  bool is_idle(double /*now*/, std::span<const double> /*memory*/ = {}) const override {
    return false;
  }

 private:
  double exponent_;
  double strength_;  ///< c / (2 dt)^a [N / m^a]
};

}  // namespace pounding::interactions
