#pragma once

#include "interactions/laws/hysteretic_law.h"
#include "interactions/laws/link_law.h"

namespace pounding::interactions {

/// Law of a link that follows a HystereticLaw: N_n = f_n of e_n and its history, W_{n+1/2} = E.
class HystereticLink final : public LinkLaw {
 public:
  explicit HystereticLink(const Hysteresis& law) : law_(law) {}

  double force(double /*before*/, double /*now*/, double /*after*/,
               std::span<const double> memory = {}) const override {
    return law_.force(next(memory));
  }
  double solve(double before, double now, double free_after, double /*compliance*/,
               std::span<const double> memory = {}) const override {
    return force(before, now, free_after, memory);
  }
  double energy(double now, double after, std::span<const double> memory = {}) const override {
    const auto last = memory.first(law_.memory_size());
    if (law_.is_untouched(last)) return law_.elastic_energy(now, after);
    return law_.stored(last) + law_.force(last) * (after - now) / 2;
  }
  double tangent() const override { return law_.tangent(); }
  bool is_explicit() const override { return true; }
  bool is_idle(double now, std::span<const double> memory = {}) const override {
    return now == 0 && law_.is_untouched(memory);
  }
  bool has_yielded(std::span<const double> memory) const override {
    return law_.ductility(memory) > 1;
  }
  bool loses_plastic_work() const override { return true; }
  double ductility(std::span<const double> memory) const override { return law_.ductility(memory); }
  double lost(std::span<const double> memory) const override { return law_.lost(memory); }
  void yield(double now, double /*kept*/, std::span<double> memory) const override {
    const auto last = memory.first(law_.memory_size());
    std::ranges::copy(last, memory.begin() + static_cast<std::ptrdiff_t>(last.size()));
    law_.advance(now, memory.last(law_.memory_size()));
  }
  void rest(double now, std::span<double> memory) const override {
    yield(now, 1, memory);
    std::ranges::copy(next(memory), memory.begin());
  }
  /// The memory of the law at the end of the last step, and in the step that is being made.
  std::size_t memory_size() const override { return 2 * law_.memory_size(); }
  void remember(double /*before*/, double /*now*/, double /*after*/, double /*share*/,
                std::span<double> memory) const override {
    std::ranges::copy(next(memory), memory.begin());
  }

 private:
  std::span<const double> next(std::span<const double> memory) const {
    return memory.last(law_.memory_size());
  }

  HystereticLaw law_;
};

}  // namespace pounding::interactions
