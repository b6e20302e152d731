#pragma once

#include "interactions/laws/link_law.h"
#include "soil/impedance.h"

namespace pounding::interactions {

/// Law of the soil under a mat in one of its motions e, but for its spring, which belongs to K: a
/// dashpot c to the ground, a dashpot c1, a spring k1 and an internal mass m in series, of which
/// spring and mass may be missing, and a mass m3 that moves with the mat. With the rates
/// r+ = (e_{n+1} - e_n) / dt and r- = (e_n - e_{n-1}) / dt, their mean r, and the rate y- of the
/// internal mass and the force Q- of the inner spring, which the law remembers, over a time d (dt,
/// and half of it in the first step):
///
///     F   = c1 (r - (Q+ - Q-) / (d k1) - (y- + y+) / 2) = (Q- + Q+) / 2,     m (y+ - y-) = d F,
///           so F = (r - y- + 2 Q- / (d k1)) c1 / (1 + c1 d / (2 m) + 2 c1 / (d k1))
///     N_n = c r + F + m3 (r+ - r-) / d
///     W   = 1/2 m y^2 + Q^2 / (2 k1) + 1/2 m3 r+^2                                         >= 0
///
/// Its loss d (c r^2 + F^2 / c1) is never less than nothing, whatever the numbers are: it does not
/// limit the time step.
class SoilLaw final : public LinkLaw {
 public:
  /// `time_step` [s]. Of the impedance all but the spring counts.
  SoilLaw(const Impedance& impedance, double time_step)
      : impedance_(impedance), time_step_(time_step) {}

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
  /// The rate of the internal mass, then the force of the inner spring, of those that there are.
  std::size_t memory_size() const override;
  void remember(double before, double now, double after, double share,
                std::span<double> memory) const override;

 private:
  /// F over r less the lag [N s/m].
  double inner_rate(double share) const;
  /// y- - 2 Q- / (d k1) [m/s].
  double lag(double share, std::span<const double> memory) const;

  Impedance impedance_;
  double time_step_;
};

}  // namespace pounding::interactions
