#pragma once

#include <cstddef>
#include <span>

namespace pounding::interactions {

/// Law by which a link pulls its two ends together along its axis in a step of central differences,
/// from elongations e [m] one step apart: `before` e_{n-1}, `now` e_n, `after` e_{n+1}. The force
/// N_n [N] acts in the step from t_n; its work is N_n (e_{n+1} - e_{n-1}) / 2, of which the link
/// keeps the change of its energy W and loses the rest. A law that never loses less than nothing,
/// for any elongations, cannot make a step unstable.
///
/// N_n must not fall as e_{n+1} grows: then a step has one solution. What a law remembers, a
/// plastic elongation say, is in `memory`, which the step keeps for each link and the checkpoint
/// stores. Pure functions: no MPI, no PETSc.
class LinkLaw {
 public:
  using Memory = std::span<const double>;

  virtual ~LinkLaw() = default;

  /// N_n [N] of known elongations [m].
  virtual double force(double before, double now, double after, Memory memory = {}) const = 0;
  /// N_n [N] where e_{n+1} = free_after - compliance N_n; `free_after` [m] without the link,
  /// `compliance` = dt^2 b^T M^-1 b [m/N], not negative. That of an explicit law unless it says
  /// otherwise.
  virtual double solve(double before, double now, double free_after, double /*compliance*/,
                       Memory memory = {}) const {
    return force(before, now, free_after, memory);
  }
  /// W_{n+1/2} [J], the energy that the link holds between two elongations one step apart.
  virtual double energy(double /*now*/, double /*after*/, Memory = {}) const { return 0; }
  /// Largest dN/de [N/m], that of the element in the matrix that sets the stable step.
  virtual double tangent() const { return 0; }
  /// Whether it pulls at no elongation that it can reach in this step: it need not be looked at.
  virtual bool is_idle(double /*now*/, Memory = {}) const { return false; }

  /// Whether its force follows from e_n and its memory alone, whatever the other rows pull.
  virtual bool is_explicit() const { return false; }
  /// Force at e_n [N] that K of its structure holds already: in all it pulls N_n and this.
  virtual double counted(double /*now*/) const { return 0; }
  /// Whether `full` and `holds_down_to` are known: unless it lets go in a step, its force follows
  /// from e_n alone.
  virtual bool holds_a_known_force() const { return false; }
  /// N_n [N] of a step in which it does not let go, the most that it can be.
  virtual double full(double /*now*/, Memory) const { return 0; }
  /// Least e_{n+1} of such a step [m].
  virtual double holds_down_to(double /*before*/, Memory) const { return 0; }
  /// Elongation up to which it never pulls [m].
  virtual double slack(Memory) const { return 0; }
  /// Takes e_0 of the rest from which the run starts, before its first step.
  virtual void rest(double /*now*/, std::span<double> /*memory*/) const {}
  /// Whether it has left its straight line for good.
  virtual bool has_yielded(Memory) const { return false; }

  /// Whether its loss is plastic work: of yielding, damage or crushing.
  virtual bool loses_plastic_work() const { return false; }

  /// Rate r [N/m] of a law N_n = r (e_{n+1} - e_{n-1}) + offset, 0 of any other: such links are
  /// solved for together, and their elongations are counted from e_n, so that these have no
  /// round-off of a large one. `share`: of a step, for which the force acts; half of the first one.
  virtual double rate(double /*share*/ = 1) const { return 0; }
  /// Offset of the force [N] at no rate, which knows differences of elongations only.
  virtual double offset(double /*before*/, double /*now*/, double /*share*/, Memory) const {
    return 0;
  }
  /// Force that a law would carry in a step from e_n if it did not yield in it [N]; 0 of a law that
  /// never yields.
  virtual double trial(double /*now*/, Memory) const { return 0; }
  /// Most of its trial that it carries [N]; 0 of a law that never yields.
  virtual double capacity() const { return 0; }
  /// Takes the force that presses on it in a step from t_n [N], before any force of its own is
  /// asked for.
  virtual void press(double /*force*/, std::span<double> /*memory*/) const {}
  /// Whether it was ever pressed harder than the law goes.
  virtual bool was_overpressed(Memory) const { return false; }
  /// Energy that the change of this force since the last step gives it from outside [J].
  virtual double given(double /*before*/, double /*now*/, Memory) const { return 0; }
  /// Yields in a step from e_n, before any force of it is asked for, until `kept` of its trial is
  /// left; 1: it does not yield.
  virtual void yield(double /*now*/, double /*kept*/, std::span<double> /*memory*/) const {}
  /// Number of values that the law remembers; they start at 0.
  virtual std::size_t memory_size() const { return 0; }
  /// Brings the memory to the end of a step, after contact. `share` as above.
  virtual void remember(double /*before*/, double /*now*/, double /*after*/, double /*share*/,
                        std::span<double> /*memory*/) const {}
};

}  // namespace pounding::interactions
