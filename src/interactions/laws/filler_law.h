#pragma once

#include <vector>

#include "interactions/laws/link_law.h"
#include "interactions/laws/tension_law.h"
#include "scene/filler.h"

namespace pounding::interactions {

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

  double force(double before, double now, double after,
               std::span<const double> memory = {}) const override;
  double solve(double before, double now, double free_after, double compliance,
               std::span<const double> memory = {}) const override;
  bool holds_a_known_force() const override { return true; }
  double full(double now, std::span<const double> memory) const override;
  double holds_down_to(double before, std::span<const double> memory) const override {
    return before > memory[1] ? memory[1] : before;
  }
  double energy(double now, double after, std::span<const double> memory = {}) const override;
  double tangent() const override { return spring_.tangent(); }
  bool is_idle(double now, std::span<const double> memory = {}) const override {
    return now <= memory[0];
  }
  bool loses_plastic_work() const override { return true; }
  bool has_yielded(std::span<const double> memory) const override { return memory[0] > 0; }
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
