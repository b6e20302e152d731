#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/types.h"
#include "motion/accelerogram.h"
#include "scene/scene.h"

namespace pounding {

/// Motion in one direction as it was understood, before it is resampled.
struct MotionDescription {
  std::string direction{};      ///< "x"
  std::string component{};      ///< of the ground, as the file names it: "N10E"; "" if it does not
  std::string source{};         ///< file of the record or of the target spectrum
  std::string layout{};         ///< "rows of 8 values that follow one another", "synthetic, seed 3"
  std::string unit{};           ///< of the file, and its source; empty for a synthetic motion
  std::size_t points = 0;       ///< samples
  double time_step = 0;         ///< between them [s]
  double duration = 0;          ///< [s]
  double start = 0;             ///< time of the run at which it sets in [s]
  double file_start = 0;        ///< first time of its time column [s]
  bool has_times = false;       ///< there is such a column
  double file_peak = 0;         ///< as in the file [m/s2]; 0 for a synthetic motion
  std::string scaling{};        ///< "to pga 3.43 m/s2", "by 0.5", "none"
  double factor = 0;            ///< on the numbers of the file [-]; 0 for a synthetic motion
  std::string treatment{};      ///< changes of baseline and sampling
  double end_velocity = 0;      ///< integral of the scaled motion at its end [m/s]
  double end_displacement = 0;  ///< its second integral there [m]
  double pga = 0;               ///< as applied [m/s2]
};

/// Ground acceleration a_g(t) in the three directions: each component is read or generated, scaled
/// (so that the peak of its samples is `pga`, or by `scale`), resampled if asked, and linear
/// between samples. It is zero before its first sample, after its last, and in directions without
/// a component. Records keep the differences between the first times of their time columns.
class GroundMotion {
 public:
  /// Reads the files; every rank may do so, or one that shares the result. Band-limited resampling
  /// goes to steps of 5e-4 s or less. Throws UserError (see read_accelerogram,
  /// generate_accelerogram; a pga for a record that is zero; a synthetic motion without pga; a peak
  /// above ten thousand g, as in the file or as scaled). `name` is that of messages.
  GroundMotion(const std::array<std::optional<MotionComponent>, 3>& components,
               Resampling resampling, std::string name = "motion");

  /// a_g [m/s2] in direction 0, 1 or 2 at time t [s].
  double acceleration(int direction, double t) const noexcept {
    return components_[direction].at(t);
  }

  /// The three components [m/s2] at time t [s].
  void evaluate(double t, Vector3& ground_acceleration) const noexcept {
    for (int direction = 0; direction < 3; ++direction) {
      ground_acceleration[direction] = acceleration(direction, t);
    }
  }

  /// The components become a wave from below, and the ground itself rests: accelerations, peaks and
  /// `active` are those of ground at rest from then on, descriptions and doubts stay. Once, before
  /// a run.
  void enter_from_below();
  bool from_below() const { return from_below_; }
  /// Lets nodes of the base part from the wave from below, by a file of run/incoherent: histories
  /// of shapes along x, y, z. After `enter_from_below`. Throws UserError.
  void add_incoherent(const std::string& file, Resampling resampling);
  /// Velocities of the wave from below along x, y, z and of the shapes of its incoherent part
  /// [m/s]: the exact integrals of accelerations that are linear between samples; they keep their
  /// last value after the last sample. Zero for a motion of the ground.
  void evaluate_incident(double t, std::span<double> velocities) const noexcept;
  /// Samples of these accelerations [m/s2]; empty in a direction without.
  std::span<const Accelerogram> incident() const { return incident_; }
  const Accelerogram& incident(int direction) const { return incident_[direction]; }

  /// Earliest of the first times of the records [s], those without a time column at 0; nothing
  /// without a record or a synthetic motion.
  std::optional<double> earliest() const;
  /// Lets t = 0 be `origin` in the times of the files [s]: a record whose times begin later sets in
  /// later. Until then it is the earliest of the records. Before `enter_from_below`.
  void count_times_from(double origin);
  /// t = 0 in the times of the files [s].
  double origin() const { return origin_; }

  /// The part of the motion that sets in between two times [s], its samples times a weight that
  /// rises from 0 to 1 as half a cosine; or the rest of it, so that both add up to the motion.
  enum class Part { sets_in, leaves };
  GroundMotion part(Part part, double from, double to) const;
  /// The motion times a factor.
  GroundMotion times(double factor) const;
  /// The motion with `origin` [s] as t = 0.
  GroundMotion counted_from(double origin) const;

  bool active(int direction) const { return !components_[direction].acceleration.empty(); }

  /// Samples applied in a direction; empty when it has no component.
  const Accelerogram& component(int direction) const { return components_[direction]; }

  /// Largest |acceleration| of each component [m/s2].
  Vector3 peaks() const;
  /// Bound of |a_g| at all times: the norm of the components' peaks, which may coincide [m/s2].
  double peak_acceleration() const;

  /// Descriptions of the directions that have a motion.
  const std::vector<MotionDescription>& descriptions() const { return descriptions_; }
  /// Doubts about the files and the peaks of their motions, one line each.
  const std::vector<std::string>& doubts() const { return doubts_; }

 private:
  void add(std::size_t direction, const MotionComponent& component);
  void add_start_doubts();

  void integrate_incident();

  std::string name_;
  double origin_ = 0;                   ///< [s]
  std::array<double, 3> file_start_{};  ///< first times of the files [s]
  std::vector<MotionDescription> descriptions_;
  std::vector<std::string> doubts_;
  std::array<Accelerogram, 3> components_{Accelerogram{{}, 1}, Accelerogram{{}, 1},
                                          Accelerogram{{}, 1}};
  bool from_below_ = false;
  std::vector<Accelerogram> incident_{components_.begin(), components_.end()};
  std::vector<std::vector<double>> incident_velocity_;  ///< of each at its samples [m/s]
};

}  // namespace pounding
