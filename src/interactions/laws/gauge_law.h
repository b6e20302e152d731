#pragma once

#include "interactions/laws/link_law.h"

namespace pounding::interactions {

/// Law of a gauge: it has an elongation and carries nothing.
class GaugeLaw final : public LinkLaw {
 public:
  double force(double /*before*/, double /*now*/, double /*after*/,
               std::span<const double> /*memory*/ = {}) const override {
    return 0;
  }
  double solve(double /*before*/, double /*now*/, double /*free_after*/, double /*compliance*/,
               std::span<const double> /*memory*/ = {}) const override {
    return 0;
  }
  double energy(double /*now*/, double /*after*/,
                std::span<const double> /*memory*/ = {}) const override {
    return 0;
  }
  double tangent() const override { return 0; }
  bool is_explicit() const override { return true; }
  bool is_idle(double /*now*/, std::span<const double> /*memory*/ = {}) const override {
    return true;
  }
};

}  // namespace pounding::interactions
