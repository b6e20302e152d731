#include "scene/motion_reader.h"

#include <initializer_list>

namespace pounding {
namespace {

using Names = OptionReader::Names;

/// Options that would have no effect are mistakes.
void forbid_all(const OptionReader& options, std::initializer_list<std::string_view> patterns,
                const Names& names, const std::string& why) {
  for (const std::string_view pattern : patterns) options.forbid(pattern, names, why);
}

RecordedMotion read_record(OptionReader& options, const Names& names) {
  RecordedMotion motion;
  motion.file = options.text("motion_<x|y|z>_record", names);
  const std::string unit = options.choice("motion_<x|y|z>_unit", names);
  motion.unit = unit == "auto" ? "" : unit;
  motion.time_step = options.real("motion_<x|y|z>_time_step", names);
  motion.column = options.integer("motion_<x|y|z>_column", names);
  if (!options.given("motion_<x|y|z>_target", names)) {
    forbid_all(
        options, {"motion_<x|y|z>_seed", "motion_<x|y|z>_duration", "motion_<x|y|z>_envelope"},
        names,
        "goes with -" + option_name("motion_<x|y|z>_target", names) + ", which is not given");
  }
  return motion;
}

SyntheticMotion read_synthetic(OptionReader& options, const Names& names) {
  forbid_all(options, {"motion_<x|y|z>_unit", "motion_<x|y|z>_time_step", "motion_<x|y|z>_column"},
             names,
             "goes with -" + option_name("motion_<x|y|z>_record", names) + ", which is not given");
  SyntheticMotion motion;
  motion.target = options.text("motion_<x|y|z>_target", names);
  motion.seed = options.integer("motion_<x|y|z>_seed", names);
  motion.duration = options.real("motion_<x|y|z>_duration", names);
  const std::vector<double> envelope = options.reals("motion_<x|y|z>_envelope", names, 2);
  motion.envelope = {envelope[0], envelope[1]};
  if (motion.envelope[0] > motion.envelope[1]) {
    options.refuse("motion_<x|y|z>_envelope", names, "t1 is above t2");
  }
  if (motion.envelope[1] > motion.duration) {
    options.refuse("motion_<x|y|z>_envelope", names,
                   "t2 is above -" + option_name("motion_<x|y|z>_duration", names));
  }
  return motion;
}

}  // namespace

std::optional<MotionComponent> read_motion(OptionReader& options, const std::string& direction) {
  const Names names{direction};
  const bool recorded = options.given("motion_<x|y|z>_record", names);
  const bool synthetic = !recorded && options.given("motion_<x|y|z>_target", names);
  if (!recorded && !synthetic) {
    for (const OptionRow& row : option_table()) {
      if (row.block == OptionBlock::motion) {
        options.forbid(row.pattern, names,
                       "there is no motion along " + direction + "; give -motion_" + direction +
                           "_record or -motion_" + direction + "_target");
      }
    }
  }
  if (!synthetic && options.text("motion_<x|y|z>_record", names) == "none") return std::nullopt;
  MotionComponent component;
  component.pga = options.real("motion_<x|y|z>_pga", names);
  component.scale = options.real("motion_<x|y|z>_scale", names);
  if (component.pga > 0 && component.scale != 1) {
    options.refuse("motion_<x|y|z>_scale", names,
                   "no effect beside -" + option_name("motion_<x|y|z>_pga", names) +
                       ", which is above 0; leave one of them out");
  }
  if (recorded) {
    component.source = read_record(options, names);
  } else {
    component.source = read_synthetic(options, names);
    if (component.pga == 0) {
      options.refuse("motion_<x|y|z>_pga", names,
                     "a synthetic motion needs a peak ground acceleration above 0");
    }
  }
  return component;
}

}  // namespace pounding
