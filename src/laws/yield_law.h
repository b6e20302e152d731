#pragma once

#include <algorithm>

#include "laws/link_law.h"

namespace pounding::interactions {

/// Law of a bilinear link, a lead rubber bearing or a brace that yields say, of stiffness k before
/// and r k after yield, at a force F. With k_e = (1 - r) k, Q = (1 - r) F and the plastic
/// elongation p_n, which it remembers,
///
///     q_n       = k_e (e_n - p_n),  |q_n| <= Q,  p_n = p_{n-1} unless |k_e (e_n - p_{n-1})| > Q
///     N_n       = r k e_n + q_n
///     W_{n+1/2} = 1/2 r k e_n e_{n+1} + 1/2 k_e (e_n - p_n) (e_{n+1} - p_n)
///
/// The loss (p_n - p_{n-1}) (q_n + q_{n-1}) / 2 is never less than nothing, and W with the kinetic
/// energy is positive below the stable step of k: a link that yields does not move that step. Where
/// two components yield together, on a circle |q| <= Q (radial return), all of this holds as well.
/// Of a sliding bearing Q follows its normal force; then the loss of a step may miss that by the
/// change of Q in it.
class YieldLaw : public LinkLaw {
 public:
  /// `stiffness` k [N/m], `hardening` r in [0, 1), `yield_force` F [N]; `slides`: by friction.
  YieldLaw(double stiffness, double hardening, double yield_force, bool slides = false)
      : after_(hardening * stiffness),
        elastic_((1 - hardening) * stiffness),
        capacity_((1 - hardening) * yield_force),
        slides_(slides) {}

  double force(double before, double now, double after, Memory memory = {}) const override;
  double energy(double now, double after, Memory memory = {}) const override;
  double tangent() const override { return after_ + elastic_; }
  bool is_explicit() const override { return true; }
  bool is_idle(double now, Memory memory = {}) const override { return now == 0 && memory[0] == 0; }
  double trial(double now, Memory memory) const override { return elastic_ * (now - memory[0]); }
  double capacity() const override { return capacity_; }
  bool has_yielded(Memory memory) const override { return memory[0] != 0; }
  bool loses_plastic_work() const override { return !slides_; }
  void yield(double now, double kept, std::span<double> memory) const override;
  /// p of the end of the last step, and of the step that is being made.
  std::size_t memory_size() const override { return 2; }
  void remember(double before, double now, double after, double share,
                std::span<double> memory) const override;

 private:
  double after_;
  double elastic_;
  double capacity_;
  bool slides_;
};

/// Law of a friction pendulum of radius R along one axis of its dish, under the force P_n that
/// presses on it in the step from t_n, none where it lifts off: the friction of a bilinear link,
/// whose capacity the step takes from P_n, and the slope of the dish,
///
///     s_n       = min( P_n / R, S )
///     N_n       = s_n e_n + q_n
///     W_{n+1/2} = 1/2 s_n e_n e_{n+1} + 1/2 k_e (e_n - p_n) (e_{n+1} - p_n)
///
/// with q and p those of YieldLaw of k_e = k - S, S = r k the most that the slope may be: k is the
/// stiffest tangent. A slope that changes gives 1/2 (s_n - s_{n-1}) e_{n-1} e_n from outside: what
/// lifts or lowers the weight on the dish does that work, so it is input and no loss.
class PendulumLaw : public YieldLaw {
 public:
  /// `stiffness` k [N/m], `hardening` r in (0, 1), `radius` [m].
  PendulumLaw(double stiffness, double hardening, double radius)
      : YieldLaw((1 - hardening) * stiffness, 0, 0, true),
        steepest_(hardening * stiffness),
        radius_(radius) {}

  double force(double before, double now, double after, Memory memory = {}) const override {
    return memory[3] * now + YieldLaw::force(before, now, after, memory);
  }
  double energy(double now, double after, Memory memory = {}) const override {
    return memory[2] * now * after / 2 + YieldLaw::energy(now, after, memory);
  }
  double tangent() const override { return steepest_ + YieldLaw::tangent(); }
  void press(double force, std::span<double> memory) const override {
    const double slope = force / radius_;
    memory[3] = std::min(slope, steepest_);
    if (slope > steepest_) memory[4] = 1;
  }
  bool was_overpressed(Memory memory) const override { return memory[4] != 0; }
  double given(double before, double now, Memory memory) const override {
    return (memory[3] - memory[2]) * before * now / 2;
  }
  /// Memory of YieldLaw; s of the end of the last step, and of the step that is being made; 1 once
  /// S has cut it.
  std::size_t memory_size() const override { return YieldLaw::memory_size() + 3; }
  void remember(double before, double now, double after, double share,
                std::span<double> memory) const override {
    YieldLaw::remember(before, now, after, share, memory);
    memory[2] = memory[3];
  }

 private:
  double steepest_;  ///< S [N/m]
  double radius_;
};

/// Law of a gauge: it has an elongation and carries nothing.
class GaugeLaw final : public LinkLaw {
 public:
  double force(double /*before*/, double /*now*/, double /*after*/, Memory = {}) const override {
    return 0;
  }
  bool is_explicit() const override { return true; }
  bool is_idle(double /*now*/, Memory = {}) const override { return true; }
};

}  // namespace pounding::interactions
