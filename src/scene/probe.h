#pragma once

#include <string>
#include <vector>

#include "common/types.h"
#include "scene/option_row.h"

namespace pounding {

struct Probe {
  std::string name;
  std::string structure;
  std::vector<Vector3> points;  ///< each snaps to the nearest node [m]
  std::string group;            ///< or all nodes of a physical group
  bool average = true;          ///< one averaged channel set, or one per node
  bool floor = false;           ///< the level of a floor, between which drifts are

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option(&Probe::structure, "<probe>_structure", text("name", required, "the name of a structure"), "the structure that it sits on");
    option(&Probe::points, "<probe>_at", text("m", absent("this or group"), "points x,y,z; x,y,z"), "points, each snapped to the nearest node");
    option(&Probe::group, "<probe>_group", text("group", absent("this or at"), "a physical group"), "all nodes of a physical group");
    option(&Probe::average, "<probe>_average", flag(true), "one averaged record instead of one per node");
    option(&Probe::floor, "<probe>_floor", flag(false), "it records the motion of a floor: drifts are those between floors");
    // clang-format on
  }
};

/// Two probes on two structures with something between them: a line, a bridge, a cable tray.
struct Span {
  std::string name;
  std::string from;
  std::string to;

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option(&Span::from, "<span>_from", text("name", required, "the name of a probe"), "the probe at its first end");
    option(&Span::to, "<span>_to", text("name", required, "the name of a probe"), "the probe at its second end, on another structure");
    // clang-format on
  }
};

/// Links whose force is recorded over their elongation: those of a region, or the filler of a
/// contact.
struct Loop {
  std::string name;             ///< structure:group, or that of the contact
  std::string structure;        ///< of the region
  std::string group;            ///< of the region
  std::string contact;          ///< or the contact
  std::vector<Vector3> points;  ///< the element nearest to each; empty: all of them [m]
};

}  // namespace pounding
