#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/types.h"

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

  bool has_level() const { return kind == ForceKind::storey || kind == ForceKind::cut; }

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
