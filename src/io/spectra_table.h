#pragma once

namespace pounding {

/// Columns of a table of response spectra, those of a run and those of pounding-spectra alike:
/// source, direction and treatment of the signal; damping ratio [-], frequency [Hz], period [s],
/// largest displacement [m], pseudo-velocity [m/s] and pseudo-acceleration [m/s2]; then the origin
/// of the row: interval between the samples [s], frequency up to which they hold it [Hz], start of
/// the part that counts [s], part by which peaks were widened to both sides [-].
inline constexpr const char* spectrum_columns =
    "probe,direction,treatment,damping,frequency,period,displacement,pseudo_velocity,"
    "pseudo_acceleration,interval,valid_up_to,start,broadening";

/// Frequency [Hz] up to which samples that are means over their `interval` [s] hold a response
/// spectrum within 1 %: they lower it by about (pi f interval)^2 / 2, which is 1 % at 0.045.
inline double faithful_up_to(double interval) {
  return 0.045 / interval;
}

}  // namespace pounding
