#pragma once

#include "interactions/laws/link_law.h"

namespace pounding::interactions {

/// Law of a bilinear link, a lead rubber bearing or a brace that yields say, of stiffness k before
/// and r k after yield, at a force F. With k_e = (1 - r) k, Q = (1 - r) F and the plastic
/// elongation p_n, which it remembers,
///
///     q_n       = k_e (e_n - p_n),  |q_n| <= Q,  p_n = p_{n-1} unless |k_e (e_n - p_{n-1})| > Q
///     N_n       = r k e_n + q_n
///     W_{n+1/2} = 1/2 r k e_n e_{n+1} + 1/2 k_e (e_n - p_n) (e_{n+1} - p_n)
///
/// Its loss (p_n - p_{n-1}) (q_n + q_{n-1}) / 2 is never less than nothing, and W with the kinetic
/// energy is positive below the stable step of k: a link that yields does not move that step. Where
/// two components yield together, on a circle |q| <= Q (radial return), all of this holds as well.
/// Of a sliding bearing Q follows its normal force; then the loss of a step may miss that by the
/// change of Q in it.
class YieldLaw final : public LinkLaw {
 public:
  /// `stiffness` k [N/m], `hardening` r in [0, 1), `yield_force` F [N]; `slides`: by friction.
  YieldLaw(double stiffness, double hardening, double yield_force, bool slides = false)
      : after_(hardening * stiffness),
        elastic_((1 - hardening) * stiffness),
        capacity_((1 - hardening) * yield_force),
        slides_(slides) {}

  double force(double before, double now, double after,
               std::span<const double> memory = {}) const override;
  double solve(double before, double now, double free_after, double compliance,
               std::span<const double> memory = {}) const override;
  double energy(double now, double after, std::span<const double> memory = {}) const override;
  double tangent() const override { return after_ + elastic_; }
  bool is_explicit() const override { return true; }
  bool is_idle(double now, std::span<const double> memory = {}) const override {
    return now == 0 && memory[0] == 0;
  }
  double trial(double now, std::span<const double> memory) const override {
    return elastic_ * (now - memory[0]);
  }
  double capacity() const override { return capacity_; }
  bool has_yielded(std::span<const double> memory) const override { return memory[0] != 0; }
  bool loses_plastic_work() const override { return !slides_; }
  void rest(double now, std::span<double> memory) const override;
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

}  // namespace pounding::interactions
