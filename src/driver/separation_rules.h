#pragma once

#include <cstddef>
#include <string>

namespace pounding {

/// One side of a joint: how far its modes let it move along the normal.
struct SeparationSide {
  std::string structure;  ///< "wall" for a rigid one
  double peak = 0;        ///< largest of all pairs [m]
  int modes = 0;
  double frequency = 0;  ///< of the mode that moves it most [Hz]
  double ratio = 0;      ///< its damping ratio [-]
};

/// The joint that a contact would need if nothing were to hit, by response spectrum: peaks of each
/// mode from the ground motion of the scene, combined by their correlations (CQC), directions by
/// the root of the sum of squares. Each rule is the largest of all pairs of the contact.
struct Separation {
  std::size_t contact = 0;  ///< of the scene
  SeparationSide secondary, primary;
  double gap = 0;          ///< at rest, the smallest [m]
  double sum = 0;          ///< u1 + u2 [m]
  double srss = 0;         ///< sqrt(u1^2 + u2^2): EN 1998-1 4.4.2.7, ASCE 7-16 12.12.3 [m]
  double ddc = 0;          ///< sqrt(u1^2 + u2^2 - 2 rho u1 u2), rho below [m]
  double modal = 0;        ///< CQC over the modes of both, the second's with the other sign [m]
  double correlation = 0;  ///< of the two modes that move the sides most [-]
};

}  // namespace pounding
