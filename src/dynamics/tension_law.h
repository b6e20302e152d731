#pragma once

namespace pounding {

/// How a tension-only bar pulls in a step of central differences, so that its energy can be told at
/// every half step. With the elongations e_{n-1}, e_n, e_{n+1}, the stiffness k, e+ = max(0, e),
/// and the damping c while e_n > 0,
///
///     W_{n+1/2} = 1/2 k e_n+ e_{n+1}+                                       the bar's energy, >= 0
///     N_n       = max(0, k e_n+ (e_{n+1}+ - e_{n-1}+) / (e_{n+1} - e_{n-1})
///                        + c (e_{n+1} - e_{n-1}) / (2 dt))                  its tension
///
/// While the bar stays taut N_n = k e_n, central differences; while it stays slack, none. Its work
/// over the step is N_n (e_{n+1} - e_{n-1}) / 2 >= W_{n+1/2} - W_{n-1/2}, equal without damping:
/// it gives back no more than it took, for any step and however it switches. (Frozen at k e_n the
/// tension feeds growing orbits below the limit of the taut bar.) N_n grows with e_{n+1}, and is at
/// most k e_n but for damping, so that the step has one solution.
struct TensionLaw {
  double stiffness = 0;     ///< k [N/m]
  double damping_rate = 0;  ///< c / (2 dt) [N/m]

  /// N_n [N] of known elongations [m].
  double tension(double before, double now, double after) const;
  /// N_n [N] where e_{n+1} = free_after - compliance N_n; `free_after` [m] without the bar,
  /// `compliance` = dt^2 b^T M^-1 b [m/N], not negative.
  double solve(double before, double now, double free_after, double compliance) const;
  /// W [J] between two elongations one step apart.
  double energy(double now, double after) const;
};

}  // namespace pounding
