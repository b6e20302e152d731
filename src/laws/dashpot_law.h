#pragma once

#include <algorithm>

#include "laws/link_law.h"
#include "soil/impedance.h"

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

  double force(double before, double /*now*/, double after, Memory = {}) const override {
    return rate_ * (after - before);
  }
  double solve(double before, double /*now*/, double free_after, double compliance,
               Memory = {}) const override {
    return rate_ * (free_after - before) / (1 + compliance * rate_);
  }
  double rate(double /*share*/ = 1) const override { return rate_; }

 private:
  double rate_;
};

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

  double force(double before, double now, double after, Memory memory = {}) const override;
  /// Force by Newton's iteration on a convex function, from the side where it never overshoots.
  double solve(double before, double now, double free_after, double compliance,
               Memory memory = {}) const override;

 private:
  double exponent_;
  double strength_;  ///< c / (2 dt)^a [N / m^a]
};

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

  double force(double before, double now, double after, Memory memory = {}) const override;
  double solve(double before, double now, double free_after, double compliance,
               Memory memory = {}) const override;
  double energy(double now, double after, Memory memory = {}) const override;
  double rate(double share = 1) const override;
  double offset(double before, double now, double share, Memory memory) const override;
  /// Q, and 1 once the first step, which is half a one, was made.
  std::size_t memory_size() const override { return 2; }
  void remember(double before, double now, double after, double share,
                std::span<double> memory) const override;

 private:
  static double share_of(Memory memory) { return memory[1] > 0 ? 1 : 0.5; }

  double stiffness_;
  double strength_;
  double exponent_;
  double time_step_;
};

/// Law of a spring N_n = k e_n beside K, whose k may be negative where others make up for it. Its
/// energy k e_n e_{n+1} / 2 is that of a spring in K, and it loses none.
class SpringLaw final : public LinkLaw {
 public:
  explicit SpringLaw(double stiffness) : stiffness_(stiffness) {}  ///< k [N/m]

  double force(double /*before*/, double now, double /*after*/, Memory = {}) const override {
    return stiffness_ * now;
  }
  double energy(double now, double after, Memory = {}) const override {
    return stiffness_ * now * after / 2;
  }
  double tangent() const override { return std::max(0.0, stiffness_); }
  bool is_explicit() const override { return true; }

 private:
  double stiffness_;
};

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
/// The loss d (c r^2 + F^2 / c1) is never less than nothing, whatever the numbers are: it does not
/// limit the time step.
class SoilLaw final : public LinkLaw {
 public:
  /// `time_step` [s]. Of the impedance all but the spring counts.
  SoilLaw(const Impedance& impedance, double time_step)
      : impedance_(impedance), time_step_(time_step) {}

  double force(double before, double now, double after, Memory memory = {}) const override;
  double solve(double before, double now, double free_after, double compliance,
               Memory memory = {}) const override;
  double energy(double now, double after, Memory memory = {}) const override;
  double rate(double share = 1) const override;
  double offset(double before, double now, double share, Memory memory) const override;
  /// The rate of the internal mass, then the force of the inner spring, of those that there are.
  std::size_t memory_size() const override;
  void remember(double before, double now, double after, double share,
                std::span<double> memory) const override;

 private:
  /// F over r less the lag [N s/m].
  double inner_rate(double share) const;
  /// y- - 2 Q- / (d k1) [m/s].
  double lag(double share, Memory memory) const;

  Impedance impedance_;
  double time_step_;
};

}  // namespace pounding::interactions
