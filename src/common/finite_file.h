#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace pounding {

/// Bytes of the largest table or record that is read; meshes and matrices may be larger.
constexpr std::uintmax_t largest_text = 512'000'000;

/// Throws UserError when a path names something that may have no end or no content, which a reader
/// must not wait for: a folder, a device, a pipe or a socket; and when it is a file of more than
/// `most` bytes. A path with nothing there passes: its reader knows the expected one. `place`
/// precedes the path in the message, such as "option -ensemble ".
void require_finite_file(const std::string& path, const std::string& place = "",
                         std::uintmax_t most = std::numeric_limits<std::uintmax_t>::max());

}  // namespace pounding
