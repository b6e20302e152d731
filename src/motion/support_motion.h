#pragma once

#include <span>
#include <string>
#include <vector>

#include "motion/accelerogram.h"
#include "motion/ground_motion.h"
#include "scene/scene.h"

namespace pounding {

/// Accelerations of supports relative to the scene's ground, a column for each component that
/// differs from it:
///
///     r''(t) = a_s(t) - a_g(t),      a_s a record of its own, or factor x a_g(t - delay)
///
/// and r'' = the record itself for rotations, since the ground does not turn.
class SupportMotion {
 public:
  /// Reads the files; every rank may do so. The times of all files, those of `ground` too, are
  /// counted from the earliest of them. `ground` must outlive this object. Throws UserError as
  /// GroundMotion does, naming the support.
  SupportMotion(std::span<const Support> supports, GroundMotion& ground, Resampling resampling);

  const std::vector<SupportColumn>& columns() const { return columns_; }
  /// r'' of all columns [m/s2, rad/s2] at time t [s].
  void evaluate(double t, std::span<double> relative_acceleration) const noexcept;

  /// Motion of a column once its records are over, and the largest until then, by the trapezoidal
  /// rule.
  struct Reach {
    double end = 0;            ///< r [m, rad]
    double largest = 0;        ///< |r|
    double end_velocity = 0;   ///< r' [m/s, rad/s]
    double largest_speed = 0;  ///< |r'|
    double peak = 0;           ///< |r''| [m/s2, rad/s2]
  };
  Reach reach(std::size_t column) const;
  /// "support west, x".
  std::string describe(std::size_t column) const;
  /// Where a column comes from: file, or "ground motion, 0.2 s later, times 0.8".
  const std::string& source(std::size_t column) const { return sources_[column].text; }
  /// Samples of a column's own record; empty where it goes by the ground's motion.
  const Accelerogram& own(std::size_t column) const { return sources_[column].own; }

  /// Doubts about the files and the motions made of them, one line each.
  std::vector<std::string> doubts() const;

 private:
  struct Source {
    Accelerogram own{{}, 1};
    double delay = 0;   ///< [s]
    double factor = 1;  ///< on the ground's motion; not with a record of its own
    std::string text;
  };
  struct Records;
  Records read(const Support& support, Resampling resampling);
  void add(std::size_t number, const Support& support, const Records& records);

  const GroundMotion& ground_;
  std::vector<SupportColumn> columns_;
  std::vector<Source> sources_;
  std::vector<std::string> names_;  ///< of the supports
  std::vector<std::string> doubts_;
};

/// Kinematic interaction: how a rigid foundation without mass moves that lies in soil which
/// vertical shear waves pass through. With a0 = omega D / V_s and a level motion u_g of the surface
/// there are, for D the depth of the underside and L half a side of it,
///
///     u / u_g = cos min(a0, 1.1),      theta / u_g = 0.26 / L (1 - cos min(a0, pi / 2))
///
/// NIST GCR 12-917-21, section 3.2.2, after Kausel, Whitman, Elsabee and Morray (1978). The factors
/// are real, so nothing is late.

/// Level acceleration of the underside [m/s2], from that of the surface. It goes on until nothing
/// is left of the filter; its part before t = 0 comes after it, so that the underside comes to rest
/// where the surface does.
Accelerogram embedded_translation(const Accelerogram& surface, const Embedment& embedment);

/// Angular acceleration [rad/s2]; positive: the top goes further than the underside along the
/// motion of the surface.
Accelerogram embedded_rotation(const Accelerogram& surface, const Embedment& embedment);

}  // namespace pounding
