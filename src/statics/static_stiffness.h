#pragma once

#include <string>
#include <vector>

namespace pounding {

/// Stiffness of a structure against forces that stay: K without one-way links, whatever damps it.
/// It may be singular, as that of a block which only rests on another; K + shift M is not.
class StaticStiffness {
 public:
  virtual ~StaticStiffness() = default;
  /// q = K u over the owned dofs [N, N m]. Collective.
  virtual void apply(const std::vector<double>& u, std::vector<double>& q) const = 0;
  /// x := (K + shift M)^-1 x over the owned dofs. Collective.
  virtual void solve(std::vector<double>& x) const = 0;
  /// How it is solved, for the report.
  virtual std::string method() const = 0;
};

}  // namespace pounding
