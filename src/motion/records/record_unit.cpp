#include "motion/records/record_unit.h"

#include <array>

#include "common/error.h"

namespace pounding {

std::optional<RecordUnit> record_unit(std::string_view name) {
  struct Known {
    std::string_view name;
    double factor;
  };
  static constexpr std::array known{Known{"g", standard_gravity},
                                    Known{"m/s2", 1},
                                    Known{"cm/s2", 0.01},
                                    Known{"mm/s2", 0.001},
                                    Known{"g/10", standard_gravity / 10},
                                    Known{"m", 1},
                                    Known{"cm", 0.01},
                                    Known{"mm", 0.001}};
  for (const Known& one : known) {
    if (one.name == name) return RecordUnit{std::string(name), one.factor};
  }
  return {};
}

RecordUnit agreed_unit(const std::string& file, const std::string& asked,
                       const std::string& stated) {
  const bool in_metres = asked == "m/s2" && stated == "mm/s2";
  refuse_if(!asked.empty() && asked != stated && !in_metres,
            file + ": unit " + asked + " is asked but the header says " + stated +
                "; leave unit out or correct the file");
  const auto unit = record_unit(in_metres ? asked : stated);
  if (!unit) throw UserError(file + ": unknown unit " + stated + "; give " + units_to_ask);
  return *unit;
}

std::string unit_text(const RecordUnit& unit, const std::string& asked) {
  return unit.name + (asked.empty() ? " (header)" : " (as asked)");
}

}  // namespace pounding
