#pragma once

#include "interactions/laws/link_law.h"

namespace pounding::interactions {

/// Law of a tension-only bar: it pulls so that its energy can be told at every half step. With the
/// elongations e_{n-1}, e_n, e_{n+1}, less its slack, the stiffness k, e+ = max(0, e), and the
/// damping c while e_n > 0,
///
///     W_{n+1/2} = 1/2 k e_n+ e_{n+1}+                                       the bar's energy, >= 0
///     N_n       = max(0, k e_n+ (e_{n+1}+ - e_{n-1}+) / (e_{n+1} - e_{n-1})
///                        + c (e_{n+1} - e_{n-1}) / (2 dt))                  its tension
///
/// While the bar stays taut N_n = k e_n, central differences; while it stays slack, none. Its work
/// over the step is N_n (e_{n+1} - e_{n-1}) / 2 >= W_{n+1/2} - W_{n-1/2}, equal without damping:
/// it gives back no more than it took, for any step and however it switches. (Frozen at k e_n the
/// tension feeds growing orbits below the limit of the taut bar.) N_n grows with e_{n+1}, and is at
/// most k e_n but for damping, so that the step has one solution.
class TensionLaw final : public LinkLaw {
 public:
  /// `stiffness` k [N/m]; `damping_rate` c / (2 dt) [N/m]; `slack` [m].
  TensionLaw(double stiffness, double damping_rate, double slack = 0)
      : stiffness_(stiffness), damping_rate_(damping_rate), slack_(slack) {}

  double force(double before, double now, double after,
               std::span<const double> memory = {}) const override;
  double solve(double before, double now, double free_after, double compliance,
               std::span<const double> memory = {}) const override;
  double energy(double now, double after, std::span<const double> memory = {}) const override;
  double tangent() const override { return stiffness_; }
  bool is_idle(double now, std::span<const double> /*memory*/ = {}) const override {
    return now <= slack_;
  }

 private:
  double stretched_force(double before, double now, double after) const;
  double solve_stretched(double before, double now, double free_after, double compliance) const;

  double stiffness_;
  double damping_rate_;
  double slack_;
};

}  // namespace pounding::interactions
