#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

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

}  // namespace pounding
