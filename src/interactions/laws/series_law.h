#pragma once

#include "interactions/laws/link_law.h"

namespace pounding::interactions {

/// Law of a dashpot in series with a spring A, by a power a of its rate. With the force Q of both
/// at half steps, which the law remembers, over a time d (dt, and half of it in the first step),
/// and the mean rate r = (e_{n+1} - e_{n-1}) / (2 dt),
///
///     N_n = (Q- + Q+) / 2 = c |y|^a sign y,     (Q+ - Q-) / d = A (r - y)
///     W   = Q^2 / (2 A)                                                                    >= 0
///
/// y is the rate of the dashpot. Its work d N_n r less the change of W is d N_n y, which is never
/// less than nothing, whatever the numbers are: it does not limit the time step. Of a linear
/// dashpot (a = 1) N_n is linear in e_{n+1}; of another one it follows by Newton's iteration on a
/// convex function.
class SeriesLaw final : public LinkLaw {
 public:
  /// `stiffness` A [N/m], `strength` c [N (s/m)^a], `exponent` a > 0, `time_step` [s].
  SeriesLaw(double stiffness, double strength, double exponent, double time_step);

  double force(double before, double now, double after,
               std::span<const double> memory = {}) const override;
  double solve(double before, double now, double free_after, double compliance,
               std::span<const double> memory = {}) const override;
  double energy(double now, double after, std::span<const double> memory = {}) const override;
  double tangent() const override { return 0; }
  bool is_idle(double /*now*/, std::span<const double> /*memory*/ = {}) const override {
    return false;
  }
  double rate(double share = 1) const override;
  double offset(double before, double now, double share,
                std::span<const double> memory) const override;
  /// Q, and 1 once the first step, which is half a one, was made.
  std::size_t memory_size() const override { return 2; }
  void remember(double before, double now, double after, double share,
                std::span<double> memory) const override;

 private:
  static double share_of(std::span<const double> memory) { return memory[1] > 0 ? 1 : 0.5; }

  double stiffness_;
  double strength_;
  double exponent_;
  double time_step_;
};

}  // namespace pounding::interactions
