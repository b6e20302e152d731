#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scene/option_reader.h"

namespace pounding {

/// Resolved options: all that `options` has read, defaults included, then those of PETSc and SLEPc,
/// as flat YAML: one `name: "value"` per line. Read back, it gives the same scene.
std::string resolved_yaml(const OptionReader& options);

/// Name and value of each line of such a text.
std::vector<std::pair<std::string, std::string>> resolved_values(const std::string& yaml);

}  // namespace pounding
