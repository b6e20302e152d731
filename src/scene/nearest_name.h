#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pounding {

/// Insertions, deletions, replacements and swaps of neighbours that turn one word into the other
/// (optimal string alignment; upper and lower case differ).
int edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `name` if it is near enough to be a slip of the pen (about one letter
/// in five, at least one); the first of equals.
std::optional<std::string> nearest_name(std::string_view name,
                                        const std::vector<std::string>& candidates);

/// "; did you mean concrete?", or "" when nothing is near.
std::string suggestion(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace pounding
