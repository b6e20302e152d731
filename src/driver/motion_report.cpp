#include "driver/motion_report.h"

#include <cstdio>

#include <nlohmann/json.hpp>

namespace pounding {

void print_motion(const GroundMotion& motion, const SupportMotion* supports) {
  std::printf("\n");
  for (const MotionDescription& d : motion.descriptions()) {
    std::printf("motion %s: %s%s%s\n  %s%s%s, %zu points every %.6g s, %.6g s", d.direction.c_str(),
                d.source.c_str(), d.component.empty() ? "" : ", component ", d.component.c_str(),
                d.layout.c_str(), d.unit.empty() ? "" : ", in ", d.unit.c_str(), d.points,
                d.time_step, d.duration);
    if (!d.unit.empty()) {
      std::printf(", peak %.4g m/s2 (%.4g g)", d.file_peak, d.file_peak / standard_gravity);
    }
    if (d.start != 0 || d.file_start != 0) {
      std::printf("\n  sets in at %.6g s: its times begin at %.6g s, t = 0 is %.6g s of them",
                  d.start, d.file_start, motion.origin());
    }
    std::printf("\n  scaled: %s; pga %.4g m/s2 (%.4g g)\n", d.scaling.c_str(), d.pga,
                d.pga / standard_gravity);
  }
  if (motion.from_below()) {
    std::printf("the motion enters from below as a wave; displacements are absolute\n");
  }
  if (motion.descriptions().empty()) std::printf("motion: none\n");
  for (std::size_t c = 0; supports != nullptr && c < supports->columns().size(); ++c) {
    const bool turns = supports->columns()[c].component >= 3;
    const SupportMotion::Reach reach = supports->reach(c);
    std::printf("%s: %s; against the ground at most %.4g %s and %.4g %s\n",
                supports->describe(c).c_str(), supports->source(c).c_str(), reach.peak,
                turns ? "rad/s2" : "m/s2", turns ? reach.largest : 1000 * reach.largest,
                turns ? "rad" : "mm");
  }
}

nlohmann::ordered_json describe_motion(const GroundMotion& motion) {
  nlohmann::ordered_json description{{"x", nullptr}, {"y", nullptr}, {"z", nullptr}};
  for (const MotionDescription& d : motion.descriptions()) {
    nlohmann::ordered_json& of = description[d.direction];
    of = {{"file", d.source},
          {"format", d.layout},
          {"points", d.points},
          {"time_step", d.time_step},
          {"duration", d.duration},
          {"scaled", d.scaling},
          {"pga", d.pga},
          {"pga_in_g", d.pga / standard_gravity},
          {"treatment", d.treatment},
          {"end_velocity", d.end_velocity},
          {"end_displacement", d.end_displacement}};
    if (!d.component.empty()) of["component"] = d.component;
    if (d.start != 0 || d.file_start != 0) {
      of["sets_in_at"] = d.start;
      of["file_start"] = d.file_start;
    }
    if (d.factor != 0) of["factor"] = d.factor;
    if (!d.unit.empty()) {
      of["unit"] = d.unit;
      of["file_peak"] = d.file_peak;
      of["file_peak_in_g"] = d.file_peak / standard_gravity;
    }
  }
  return description;
}

nlohmann::ordered_json describe_supports(const SupportMotion& supports) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::size_t c = 0; c < supports.columns().size(); ++c) {
    const SupportMotion::Reach reach = supports.reach(c);
    list.push_back({{"component", supports.describe(c)},
                    {"source", supports.source(c)},
                    {"peak", reach.peak},
                    {"largest", reach.largest},
                    {"end", reach.end}});
  }
  return list;
}

}  // namespace pounding
