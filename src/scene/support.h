#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/types.h"
#include "scene/option_row.h"

namespace pounding {

/// A recorded accelerogram in a file, or the record of a displacement.
struct RecordedMotion {
  std::string file;
  std::string unit;  ///< "", "g", "m/s2", "cm/s2" or "mm/s2"; "": the file's own header says it;
                     ///< of a displacement "m", "cm" or "mm"
  double time_step =
      0;           ///< [s]; needed for files without a time column or header; 0: from the file
  int column = 0;  ///< of the acceleration, or component of the file, 1-based; 0: the only one

  bool is_of_displacement() const { return unit == "m" || unit == "cm" || unit == "mm"; }

  static void describe(auto& option, const std::string& prefix) {
    using namespace option_words;
    // clang-format off
    option(&RecordedMotion::time_step, prefix + "time_step", real("s", "0", not_negative), "time step of the record; 0: from the file; needed where it is above 0.1 s");
    option(&RecordedMotion::column, prefix + "column", integer("-", "0", not_negative), "column of the acceleration, from 1, or which of the components of a file that holds several; 0: the only one");
    // clang-format on
  }
};

/// A synthetic accelerogram matched to a 5 % target spectrum.
struct SyntheticMotion {
  std::string target;  ///< CSV of frequency [Hz], pseudo-acceleration / PGA [-]
  int seed = 1;
  double duration = 25;                   ///< [s]
  std::array<double, 2> envelope{2, 15};  ///< end of the rise, start of the decay [s]

  static void describe(auto& option, const std::string& prefix) {
    using namespace option_words;
    // clang-format off
    option(&SyntheticMotion::target, prefix + "target", text("file", absent("optional"), "a file"), "synthetic motion: file of its target spectrum; needs a pga");
    option(&SyntheticMotion::seed, prefix + "seed", integer("-", "1", not_negative), "synthetic motion: seed of the phases");
    option(&SyntheticMotion::duration, prefix + "duration", real("s", "25", positive), "synthetic motion: duration");
    option(&SyntheticMotion::envelope, prefix + "envelope", reals("s", "2,15", "two numbers t1,t2 with t1 <= t2 <= duration", not_negative), "synthetic motion: end of the rise, start of the decay");
    // clang-format on
  }
};

/// Ground motion in one direction: scaled to a peak ground acceleration, or by a factor.
struct MotionComponent {
  std::variant<RecordedMotion, SyntheticMotion> source;
  double pga = 0;    ///< [m/s2]; 0: as recorded times `scale`
  double scale = 1;  ///< [-]

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option("motion_<x|y|z>_record", text("file", "none", "a file or none"), "recorded accelerogram; none: no motion; wins over a target");
    option("motion_<x|y|z>_unit", word("auto|g|m/s2|cm/s2|mm/s2", "auto"), "unit of the record; auto: from the header of the file");
    describe_details(option, "motion_<x|y|z>_");
    // clang-format on
  }

  /// Options beside the record, of the ground or of a support.
  static void describe_details(auto& option, const std::string& prefix) {
    using namespace option_words;
    // clang-format off
    option.template part<RecordedMotion>(prefix);
    option.template part<SyntheticMotion>(prefix);
    option(prefix + "pga", real("m/s2", "0", not_negative), "peak ground acceleration to scale to; 0: as recorded");
    option(prefix + "scale", real("-", "1"), "factor on the record, where no pga is given");
    // clang-format on
  }
};

/// Options of the motion of a support along an axis.
struct SupportMotionOptions {
  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option("<support>_motion_<x|y|z>_record", text("file", absent("left out: the motion of the ground"), "a file or none"), "its own accelerogram along this axis; none: it is at rest; wins over a target");
    option("<support>_motion_<x|y|z>_unit", word("auto|g|m/s2|cm/s2|mm/s2|m|cm|mm", "auto"), "unit of the record; auto: from the header of the file; m, cm, mm: of its displacement");
    MotionComponent::describe_details(option, "<support>_motion_<x|y|z>_");
    // clang-format on
  }
};

/// Options of the rotation of a support about an axis.
struct SupportRotationOptions {
  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option("<support>_rotation_<x|y|z>_record", text("file", absent("left out: it does not turn"), "a file"), "record of its angular acceleration about this axis, in rad/s2");
    option.template part<RecordedMotion>("<support>_rotation_<x|y|z>_");
    option("<support>_rotation_<x|y|z>_scale", real("-", "1"), "factor on the record");
    // clang-format on
  }
};

/// A physical group of a structure whose clamped nodes are on a support, or all ground of the
/// structure.
struct SupportedGroup {
  std::string structure;
  std::string group;  ///< empty: all clamped nodes, and the ground of springs, dashpots and soil

  bool is_all_ground() const { return group.empty(); }
};

/// Soil around a rigid foundation that lies below the surface.
struct Embedment {
  double depth = 0;       ///< of its underside [m]
  double velocity = 0;    ///< of shear waves in the soil around it [m/s]
  double half_width = 0;  ///< half a side of it, or its radius [m]

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option(&Embedment::depth, "<support>_embedment", real("m", "0", not_negative), "depth of a rigid foundation below the surface: along and about x and y it moves as one does in vertical shear waves that give the surface the motion of the ground; 0: it is not embedded");
    option(&Embedment::velocity, "<support>_vs", real("m/s", absent("required with an embedment"), positive), "speed of shear waves in the soil around it", needs(&Embedment::is_deep, "goes with -<support>_embedment, which is not given"));
    option(&Embedment::half_width, "<support>_half_width", real("m", absent("required with an embedment"), positive), "half a side of the foundation, or its radius", needs(&Embedment::is_deep, "goes with -<support>_embedment, which is not given"));
    // clang-format on
  }

  bool is_deep() const { return depth > 0; }
  double travel() const { return depth / velocity; }  ///< of a wave from it to the surface [s]
};

/// A part of the ground that moves on its own, as one rigid body, with all that is clamped to it;
/// or all the ground of a structure, springs included.
struct Support {
  std::string name;
  std::vector<SupportedGroup> groups;
  double delay = 0;         ///< with which the scene's motion arrives [s]
  Vector3 factor{1, 1, 1};  ///< on that motion; 0: it is at rest
  /// Motion of its own along x, y, z, in place of that; rotations about them [rad/s2].
  std::array<std::optional<MotionComponent>, 6> motion;
  Vector3 point{0, 0, 0};  ///< about which it turns [m]
  /// It moves as a massless embedded foundation does in the waves that move the surface.
  std::optional<Embedment> embedment;

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option("<support>_groups", text("groups", required, "structure:group,structure"), "its groups with clamped nodes, or a structure with all its ground, springs and soil included");
    option(&Support::delay, "<support>_delay", real("s", "0", not_negative), "time by which the motion of the ground arrives there later");
    option(&Support::factor, "<support>_factor", reals("-", "1,1,1", "three numbers along x, y, z"), "factors on the motion of the ground there");
    option("<support>_point", reals("m", absent("required with a rotation or an embedment"), "three numbers x,y,z"), "point about which it turns");
    option.template part<Embedment>();
    // clang-format on
  }
};

/// One component of the motion of a support beside that of the scene's ground: displacement along
/// an axis (0-2) or rotation (3-5).
struct SupportColumn {
  int support = 0;
  int component = 0;
  Vector3 point{0, 0, 0};  ///< about which it turns [m]
};

}  // namespace pounding
