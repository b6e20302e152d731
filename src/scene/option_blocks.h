#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scene/option_table.h"

/// Names that the user gave, found from the options that carry them.
namespace pounding {

/// Physical groups of a structure that have any option of a region, in alphabetical order.
std::set<std::string> region_groups(const OptionsDatabase& database, const std::string& structure);

/// Names X for which every required option of the block (material, section, contact or probe) is
/// given; for a probe also `at` or `group`.
std::vector<std::string> complete_names(const OptionsDatabase& database, OptionBlock block);

/// Why `name` cannot name a structure, a contact or a probe, if it cannot: not a letter then
/// letters, digits and _; or its options could be taken for those of something else.
std::optional<std::string> name_fault(const std::string& name);

}  // namespace pounding
