#include "scene/motion_reader.h"

namespace pounding {
namespace {

using Names = OptionReader::Names;

/// Reads the motion along one axis, of the ground or of a support.
class AxisReader {
 public:
  AxisReader(OptionReader& options, const std::string& direction, const std::string& support)
      : options_(options),
        direction_(direction),
        prefix_(support.empty() ? "" : "<support>_"),
        names_(support.empty() ? Names{direction} : Names{support, direction}) {}

  bool given(const char* what) const { return options_.given(pattern(what), names_); }

  std::optional<MotionComponent> read() {
    const bool recorded = given("record");
    const bool synthetic = !recorded && given("target");
    if (!recorded && !synthetic) forbid_details();
    if (!synthetic && (!recorded || text("record") == "none")) {
      if (prefix_.empty()) text("record");  // in force
      return std::nullopt;
    }
    MotionComponent component;
    component.pga = options_.real(pattern("pga"), names_);
    component.scale = options_.real(pattern("scale"), names_);
    options_.refuse_if(
        component.pga > 0 && component.scale != 1, pattern("scale"), names_,
        "no effect beside -" + pattern("pga") + ", which is above 0; leave one of them out");
    if (recorded) {
      const RecordedMotion record = read_record();
      options_.refuse_if(record.is_of_displacement() && component.pga > 0, pattern("pga"), names_,
                         "a record of displacement takes a scale");
      component.source = record;
    } else {
      component.source = read_synthetic();
      options_.refuse_if(component.pga == 0, pattern("pga"), names_,
                         "a synthetic motion needs a peak ground acceleration above 0");
    }
    return component;
  }

 private:
  std::string pattern(const char* what) const { return prefix_ + "motion_<x|y|z>_" + what; }
  std::string text(const char* what) { return options_.text(pattern(what), names_); }

  /// Options that would have no effect are mistakes.
  void forbid_details() const {
    const std::string why = "there is no motion along " + direction_ + "; give -" +
                            pattern("record") + " or -" + pattern("target");
    if (prefix_.empty()) {
      options_.forbid_all<MotionComponent>(names_, why);
    } else {
      options_.forbid_all<SupportMotionOptions>(names_, why);
    }
  }

  RecordedMotion read_record() {
    RecordedMotion motion;
    motion.file = text("record");
    const std::string unit = options_.choice(pattern("unit"), names_);
    motion.unit = unit == "auto" ? "" : unit;
    options_.read(motion, names_, pattern(""));
    if (!given("target")) {
      options_.forbid_all<SyntheticMotion>(names_, goes_with(pattern("target")), "", pattern(""));
    }
    return motion;
  }

  SyntheticMotion read_synthetic() {
    const std::string why = goes_with(pattern("record"));
    options_.forbid(pattern("unit"), names_, why);
    options_.forbid_all<RecordedMotion>(names_, why, "", pattern(""));
    SyntheticMotion motion;
    options_.read(motion, names_, pattern(""));
    options_.refuse_if(motion.envelope[0] > motion.envelope[1], pattern("envelope"), names_,
                       "t1 is above t2");
    options_.refuse_if(motion.envelope[1] > motion.duration, pattern("envelope"), names_,
                       "t2 is above -" + pattern("duration"));
    return motion;
  }

  OptionReader& options_;
  std::string direction_;
  std::string prefix_;
  Names names_;
};

}  // namespace

std::optional<MotionComponent> read_motion(OptionReader& options, const std::string& direction,
                                           const std::string& support) {
  return AxisReader(options, direction, support).read();
}

}  // namespace pounding
