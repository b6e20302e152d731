#pragma once

#include <algorithm>

#include "interactions/laws/yield_law.h"

namespace pounding::interactions {

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
class PendulumLaw final : public LinkLaw {
 public:
  /// `stiffness` k [N/m], `hardening` r in (0, 1), `radius` [m].
  PendulumLaw(double stiffness, double hardening, double radius)
      : friction_((1 - hardening) * stiffness, 0, 0),
        steepest_(hardening * stiffness),
        radius_(radius) {}

  double force(double before, double now, double after,
               std::span<const double> memory = {}) const override {
    return memory[3] * now + friction_.force(before, now, after, memory);
  }
  double solve(double before, double now, double free_after, double /*compliance*/,
               std::span<const double> memory = {}) const override {
    return force(before, now, free_after, memory);
  }
  double energy(double now, double after, std::span<const double> memory = {}) const override {
    return memory[2] * now * after / 2 + friction_.energy(now, after, memory);
  }
  double tangent() const override { return steepest_ + friction_.tangent(); }
  bool is_explicit() const override { return true; }
  bool is_idle(double now, std::span<const double> memory = {}) const override {
    return friction_.is_idle(now, memory);
  }
  double trial(double now, std::span<const double> memory) const override {
    return friction_.trial(now, memory);
  }
  void yield(double now, double kept, std::span<double> memory) const override {
    friction_.yield(now, kept, memory);
  }
  void press(double force, std::span<double> memory) const override {
    const double slope = force / radius_;
    memory[3] = std::min(slope, steepest_);
    if (slope > steepest_) memory[4] = 1;
  }
  bool was_overpressed(std::span<const double> memory) const override { return memory[4] != 0; }
  double given(double before, double now, std::span<const double> memory) const override {
    return (memory[3] - memory[2]) * before * now / 2;
  }
  bool has_yielded(std::span<const double> memory) const override {
    return friction_.has_yielded(memory);
  }
  /// That of YieldLaw; s of the end of the last step, and of the step that is being made; 1 once S
  /// has cut it.
  std::size_t memory_size() const override { return friction_.memory_size() + 3; }
  void remember(double before, double now, double after, double share,
                std::span<double> memory) const override {
    friction_.remember(before, now, after, share, memory);
    memory[2] = memory[3];
  }

 private:
  YieldLaw friction_;
  double steepest_;  ///< S [N/m]
  double radius_;
};

}  // namespace pounding::interactions
