#pragma once

namespace pounding::interactions {

/// Force N >= 0 [N] of a dashpot N = strength y^exponent whose rate is y = right - slope N, by
/// Newton's iteration on a convex function, from the side where it never overshoots. `strength` and
/// `exponent` above 0, `right` and `slope` not below.
double power_force(double strength, double exponent, double slope, double right);

}  // namespace pounding::interactions
