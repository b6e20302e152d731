#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace pounding {

/// Unit of a record and the factor from it to m/s2, or to m.
struct RecordUnit {
  std::string name;
  double factor = 1;
};

/// The unit of that name: g, m/s2, cm/s2, mm/s2, g/10, m, cm or mm; nothing for another.
std::optional<RecordUnit> record_unit(std::string_view name);

/// Units that may be asked for, as messages name them.
inline constexpr const char* units_to_ask = "g, m/s2, cm/s2 or mm/s2";

/// The unit of a file that states one: that of the file, which `asked` ("" for none) must not
/// contradict. Numbers of a file in mm/s2 may be asked for as m/s2, which many scale by 0.001
/// themselves. Throws UserError.
RecordUnit agreed_unit(const std::string& file, const std::string& asked,
                       const std::string& stated);

/// The unit and its source: "cm/s2 (header)".
std::string unit_text(const RecordUnit& unit, const std::string& asked);

/// One g [m/s2]: the standard value, used for every file in g.
inline constexpr double standard_gravity = 9.80665;

/// Peak of a file in g beyond any ground motion [m/s2], 20 g: the unit is wrong.
inline constexpr double largest_peak = 20 * standard_gravity;

/// Beyond any study of a scheme's limits and any system of units [m/s2], ten thousand g.
inline constexpr double impossible_peak = 1e4 * standard_gravity;

/// Displacement [m] of a ground up to which it may jump whatever the acceleration.
inline constexpr double possible_jump = 1;

}  // namespace pounding
