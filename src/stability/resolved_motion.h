#pragma once

#include <limits>
#include <span>
#include <string>

namespace pounding {

/// The fastest motion that a run is asked to resolve, which bounds the step that is chosen where
/// none is given: central differences make a frequency too high by the part (omega dt)^2 / 24.
struct ResolvedMotion {
  double omega = 0;       ///< circular frequency [rad/s]; 0: nothing vibrates
  bool is_mode = false;   ///< that of a mode; otherwise of the last frequency of the spectra
  std::string structure;  ///< whose
  std::string load{};     ///< the load whose history it is; empty: none

  double frequency() const;         ///< [Hz]
  double accurate_step() const;     ///< [s]; infinite where nothing vibrates
  double error(double step) const;  ///< part by which a time step makes it too high [-]
};

/// Largest omega dt that a run resolves [-]: an error of the frequency of 0.3 %.
inline constexpr double resolved_angle = 0.268;

/// Up to which frequency a time step errs by no more [Hz].
double resolved_frequency(double step);

/// Motion of a structure that is to be resolved: its highest mode not above `last` [Hz], or one at
/// `last` where that mode is not known: `frequencies` are those of the lowest modes [Hz], `all`
/// where it has no others, `omega_max` [rad/s] that of the highest.
ResolvedMotion resolved_motion(std::span<const double> frequencies, bool all, double omega_max,
                               double last);

/// The faster one of two motions.
ResolvedMotion faster(const ResolvedMotion& a, const ResolvedMotion& b);

/// Bounds of the time step of a run.
struct StepLimits {
  double stable = std::numeric_limits<double>::infinity();  ///< the stable step [s]
  ResolvedMotion resolved;                                  ///< the fastest motion to be resolved
};

/// The limit that a time step in force comes from.
enum class StepSource { given, stability, resolution, samples };

}  // namespace pounding
