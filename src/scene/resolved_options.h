#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scene/option_reader.h"

namespace pounding {

/// What `options` has read, defaults included, then the options meant for PETSc and SLEPc, as flat
/// YAML: one `name: "value"` per line. Read back, it gives the same scene.
std::string resolved_yaml(const OptionReader& options);

/// Name and value of each line of such a text.
std::vector<std::pair<std::string, std::string>> resolved_values(const std::string& yaml);

}  // namespace pounding
