#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/types.h"
#include "scene/option_row.h"

namespace pounding {

/// History of a load: a function of time without unit, which multiplies its forces.
struct LoadFunction {
  enum class Kind : std::uint8_t {
    constant,  ///< 1 at all times, before the run as well
    step,      ///< 0 before `start`, then 1
    ramp,      ///< from 0 at `start` to 1 after `rise`, then 1
    harmonic,  ///< sin(2 pi frequency (t - start) + phase) from `start` on, before it 0
    table      ///< linear between the values, the first before them and the last after them
  };
  Kind kind = Kind::constant;
  double start = 0;            ///< [s]
  double rise = 0;             ///< [s]
  double frequency = 0;        ///< [Hz]
  double phase = 0;            ///< [rad]
  std::string file;            ///< of a table; empty: it is given here
  std::vector<double> times;   ///< of a table, increasing [s]
  std::vector<double> values;  ///< of a table [-]

  bool is_harmonic() const { return kind == Kind::harmonic; }
  bool rises() const { return kind == Kind::ramp; }
  bool sets_in() const { return is_harmonic() || rises() || kind == Kind::step; }

  static void describe(auto& option) {
    using namespace option_words;
    constexpr std::string_view no_number = "the history of load <load> has no such number";
    // clang-format off
    option("<load>_function", word("constant|step|ramp|harmonic", "constant"), "history: 1 all the time, before the run as well; 0, then 1 from start on; from 0 at start to 1 after rise; a sine from start on");
    option("<load>_table", text("file", absent("optional"), "a file"), "history: a text file of two columns, time in s and value, linear between; before the first and after the last time their values");
    option("<load>_values", text("s,-", absent("optional"), "pairs t,value; t,value with increasing t"), "history: such a table in place");
    option(&LoadFunction::start, "<load>_start", real("s", "0", not_negative), "step, ramp, harmonic: time at which it sets in", needs(&LoadFunction::sets_in, no_number));
    option(&LoadFunction::rise, "<load>_rise", real("s", absent("required with a ramp"), positive), "ramp: time from 0 to 1", needs(&LoadFunction::rises, no_number));
    option(&LoadFunction::frequency, "<load>_frequency", real("Hz", absent("required with a harmonic load"), positive), "harmonic: its frequency", needs(&LoadFunction::is_harmonic, no_number));
    option(&LoadFunction::phase, "<load>_phase", real("rad", "0"), "harmonic: phase at start", needs(&LoadFunction::is_harmonic, no_number));
    // clang-format on
  }
};

/// Forces on a physical group of a structure, all with one history. [SI, along global axes]
struct Load {
  std::string name;
  std::string structure;
  std::string group;
  Vector3 force{0, 0, 0};          ///< on every node of the group [N]
  Vector3 moment{0, 0, 0};         ///< on every node of the group [N m]
  Vector3 line_force{0, 0, 0};     ///< per length of its lines [N/m]
  Vector3 surface_force{0, 0, 0};  ///< per area of its surfaces [N/m2]
  double pressure = 0;             ///< onto its surfaces, against their outer normal [N/m2]
  Vector3 body_force{0, 0, 0};     ///< per volume of its elements [N/m3]
  double factor = 1;               ///< on all of these [-]
  LoadFunction function;

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option("<load>_on", text("group", required, "structure:group or structure:x,y,z; x,y,z"), "the group that it acts on, or points, each snapped to the nearest node");
    option(&Load::force, "<load>_force", reals("N", absent("optional"), "three numbers along x, y, z"), "force on each node of the group");
    option(&Load::moment, "<load>_moment", reals("N m", absent("optional"), "three numbers about x, y, z"), "moment on each node of the group");
    option(&Load::line_force, "<load>_line_force", reals("N/m", absent("optional"), "three numbers along x, y, z"), "force per length of the lines of the group; of beams with the moments at their ends that it has when they are held");
    option(&Load::surface_force, "<load>_surface_force", reals("N/m2", absent("optional"), "three numbers along x, y, z"), "force per area of the surfaces of the group");
    option(&Load::pressure, "<load>_pressure", real("N/m2", absent("optional")), "pressure onto the surfaces of the group: into the solid behind them, of shells against the normal of the order of their nodes");
    option(&Load::body_force, "<load>_body_force", reals("N/m3", absent("optional"), "three numbers along x, y, z"), "force per volume of the elements of the group");
    option(&Load::factor, "<load>_factor", real("-", "1"), "factor on all of these");
    // clang-format on
    option.part(&Load::function);
  }
};

/// Forces that a run records.
enum class ForceKind : std::uint8_t {
  reactions,  ///< of the ground on a structure, three forces and three moments
  storey,     ///< three forces and three moments through a level
  members,    ///< of beams, bars and springs, at their ends
  shells,     ///< forces and moments per length at the centres of shells
  cut         ///< forces of the elements of a group through a plane
};

/// An item of the option `forces`.
struct ForceItem {
  std::string name;
  std::string structure;
  ForceKind kind = ForceKind::reactions;
  double level = 0;                ///< of a storey or a cut: along the normal from the origin [m]
  Vector3 normal{0, 0, 1};         ///< of a cut, of length 1, towards the side beyond
  std::optional<Vector3> about{};  ///< moments are about this point [m]; nothing: see `point`
  std::string group;               ///< of members, shells and cuts
  std::vector<Vector3> points;     ///< elements nearest to these only [m]; empty: all of the group

  /// Forces of single elements, in place of a total.
  bool of_elements() const { return kind == ForceKind::members || kind == ForceKind::shells; }

  bool is_total() const { return !of_elements(); }
  bool is_cut() const { return kind == ForceKind::cut; }
  bool has_group() const { return of_elements() || is_cut(); }
  bool has_level() const { return kind == ForceKind::storey || is_cut(); }

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option(&ForceItem::structure, "<force>_structure", text("name", required, "the name of a structure"), "the structure that they are of");
    option(&ForceItem::kind, "<force>_kind", word("reactions|storey|members|shells|cut", required), "reactions: forces of the ground on it; storey: forces through a level; members: at the ends of beams, bars and springs; shells: forces and moments per length at their centres; cut: forces of a group through a plane");
    option(&ForceItem::level, "<force>_level", real("m", absent("storey and cut only")), "z of the level; of a cut its distance from the origin along the normal", needs(&ForceItem::has_level, "only with -<force>_kind storey or cut"));
    option(&ForceItem::normal, "<force>_normal", reals("-", absent("left out: 0,0,1"), "three numbers x,y,z, not all zero"), "cut: normal of its plane, which points to the side that the force acts on", needs(&ForceItem::is_cut, "only with -<force>_kind cut"));
    option(&ForceItem::about, "<force>_about", reals("m", absent("left out: the origin, of a storey or cut the point of its plane nearest to it"), "three numbers x,y,z"), "point that the moments are about", needs(&ForceItem::is_total, "only with -<force>_kind reactions, storey or cut"));
    option(&ForceItem::group, "<force>_group", text("group", absent("members, shells and cut only"), "a physical group"), "the elements", needs(&ForceItem::has_group, "only with -<force>_kind members, shells or cut"));
    option(&ForceItem::points, "<force>_at", text("m", absent("left out: peaks of all of them, no history"), "points x,y,z; x,y,z"), "the element of the group nearest to each point, with its history", needs(&ForceItem::of_elements, "only with -<force>_kind members or shells"));
    // clang-format on
  }

  /// Point of the moments [m]: of a level the foot of the origin on it unless given.
  Vector3 point() const {
    const double away = has_level() ? level : 0;
    return about.value_or(Vector3{away * normal[0], away * normal[1], away * normal[2]});
  }

  /// Whether a place is beyond the level [m].
  bool beyond(const Vector3& x) const {
    constexpr double round_off = 1e-9;  // m
    return normal[0] * x[0] + normal[1] * x[1] + normal[2] * x[2] > level + round_off;
  }
};

}  // namespace pounding
