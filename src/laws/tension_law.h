#pragma once

#include <utility>
#include <vector>

#include "laws/link_law.h"
#include "scene/filler.h"

namespace pounding::interactions {

/// A spring in series with a dashpot, beside the spring of a bar: dq/dt = A de/dt - omega q.
struct MaxwellBranch {
  double stiffness = 0;  ///< A [N/m]
  double rate = 0;       ///< omega [1/s]
};

/// Law of a tension-only bar: it pulls so that its energy is known at every half step. With the
/// elongations e_{n-1}, e_n, e_{n+1}, less its slack, the stiffness k, e+ = max(0, e), and the
/// force D_n of its damping while e_n > 0,
///
///     W_{n+1/2} = 1/2 k e_n+ e_{n+1}+ + sum_i q_i^2 / (2 A_i)               the bar's energy, >= 0
///     S_n       = k e_n+ (e_{n+1}+ - e_{n-1}+) / (e_{n+1} - e_{n-1})        of its spring
///     D_n       = c r + sum_i (q_i- + q_i+) / 2,   r = (e_{n+1} - e_{n-1}) / (2 dt)
///     N_n       = max(0, S_n + D_n)                                         its tension
///
/// of a dashpot c and of Maxwell branches, whose forces q_i it remembers:
///
///     (q_i+ - q_i-) / d = A_i r' - omega_i (q_i- + q_i+) / 2
///
/// over the time d (dt, half of it in the first step). r' = r while the bar pulls; where S_n + D_n
/// would push, r' >= r is the rate that leaves D_n = -S_n, the rest is slip; while the bar is slack
/// r' = 0. While the bar stays taut S_n = k e_n, central differences; while it stays slack, none.
/// The work N_n (e_{n+1} - e_{n-1}) / 2 less W_{n+1/2} - W_{n-1/2} is at least
/// d (c r'^2 + sum_i omega_i qbar_i^2 / A_i) >= 0, and 0 without damping: it gives back no more
/// than it took, for any step and however it switches. (Frozen at k e_n the tension feeds growing
/// orbits below the limit of the taut bar.) N_n grows with e_{n+1}, so that the step has one
/// solution; damping does not limit it.
class TensionLaw : public LinkLaw {
 public:
  /// `stiffness` k [N/m]; `damping_rate` c / (2 dt) [N/m]; `slack` [m].
  TensionLaw(double stiffness, double damping_rate, double slack = 0)
      : stiffness_(stiffness), damping_rate_(damping_rate), slack_(slack) {}
  /// Law under uniform damping: the spring is `at_rest` times as stiff as the bar at rest, whose
  /// `stiffness` [N/m] is given, and has branches beside it; `time_step` dt [s].
  TensionLaw(double stiffness, double damping_rate, double slack, double at_rest,
             std::vector<MaxwellBranch> branches, double time_step)
      : stiffness_(at_rest * stiffness),
        damping_rate_(damping_rate),
        slack_(slack),
        at_rest_(at_rest),
        branches_(std::move(branches)),
        time_step_(time_step) {}

  double force(double before, double now, double after, Memory memory = {}) const override;
  double solve(double before, double now, double free_after, double compliance,
               Memory memory = {}) const override;
  double energy(double now, double after, Memory memory = {}) const override;
  double tangent() const override { return stiffness_; }
  bool is_idle(double now, Memory memory = {}) const override { return now <= slack(memory); }
  double slack(Memory memory) const override {
    return memory.empty() ? slack_ : slack_ + memory.back();
  }
  /// q of the branches, and the part of the slack by a rest.
  std::size_t memory_size() const override { return branches_.empty() ? 0 : branches_.size() + 1; }
  void rest(double now, std::span<double> memory) const override;
  void remember(double before, double now, double after, double share,
                std::span<double> memory) const override;

 private:
  /// D_n = rate (e_{n+1} - e_{n-1}) + offset as long as the bar pulls.
  struct Damping {
    double rate = 0;    ///< [N/m]
    double offset = 0;  ///< [N]
  };
  Damping damping(double share, Memory memory) const;
  /// S_n; elongations here and below less the slack.
  double spring_force(double before, double now, double after) const;
  double stretched_force(const Damping& damping, double before, double now, double after) const;
  double solve_stretched(const Damping& damping, double before, double now, double free_after,
                         double compliance) const;

  double stiffness_;
  double damping_rate_;
  double slack_;
  double at_rest_ = 1;
  std::vector<MaxwellBranch> branches_;
  double time_step_ = 0;
};

/// Law of the filler of a joint at one pair of a contact. Its elongation is how far the faces have
/// come together since they touched it, d = compression [m]; with the force F(d) of its table under
/// first loading, the stiffness k on which it unloads, and the crushed length p_n, which it
/// remembers,
///
///     p_n = max( p_{n-1}, d_n - F(d_n) / k )
///
/// it holds the energy of a spring k which presses once d exceeds p_n, W_{n+1/2} = 1/2 k
/// max(0, d_n - p_n) max(0, d_{n+1} - p_n), as TensionLaw does. It presses by N_n = k (d_n - p_n),
/// which is F(d_n) while it crushes. Where it lets go in the step N_n is less, that of TensionLaw,
/// so that it gives no more than it holds; where it was not pressed at d_{n-1} it does not throw
/// back beyond d_{n-1}. Its loss is never less than nothing, for any compressions: a filler that
/// crushes or lets go does not move the stable step of k.
class FillerLaw final : public LinkLaw {
 public:
  /// `thickness` [m], `area` [m2] of the pair.
  FillerLaw(const Filler& filler, double thickness, double area);

  /// F [N] at a compression [m] under first loading; beyond the table on its last slope.
  double first_loading(double compression) const;

  double force(double before, double now, double after, Memory memory = {}) const override;
  double solve(double before, double now, double free_after, double compliance,
               Memory memory = {}) const override;
  bool holds_a_known_force() const override { return true; }
  double full(double now, Memory memory) const override;
  double holds_down_to(double before, Memory memory) const override {
    return before > memory[1] ? memory[1] : before;
  }
  double energy(double now, double after, Memory memory = {}) const override;
  double tangent() const override { return spring_.tangent(); }
  bool is_idle(double now, Memory memory = {}) const override { return now <= memory[0]; }
  bool loses_plastic_work() const override { return true; }
  bool has_yielded(Memory memory) const override { return memory[0] > 0; }
  /// Crushes it, whatever `kept` is: its table tells how far.
  void yield(double now, double kept, std::span<double> memory) const override;
  /// p of the end of the last step, and of the step that is being made.
  std::size_t memory_size() const override { return 2; }
  void remember(double before, double now, double after, double share,
                std::span<double> memory) const override;

 private:
  struct Point {
    double compression = 0;  ///< [m]
    double force = 0;        ///< [N]
  };
  std::vector<Point> points_;  ///< (0, 0) first
  TensionLaw spring_;
};

}  // namespace pounding::interactions
