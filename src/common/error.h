#pragma once

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include "common/types.h"

namespace pounding {

/// A mistake in the input. The message is one line: fault, place (file, option, group), the value
/// seen, remedy. It ends the run with exit status 1 on every rank.
class UserError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A run that a signal stopped and that can be continued. Exit status 2.
class StoppedBySignal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A run that had to stop for its own good: divergence, not a number. Exit status 1.
class DivergenceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws UserError if something is wrong. `why` is made in any case: it must name nothing that is
/// there only then, and loops over a mesh throw on their own.
inline void refuse_if(bool wrong, const std::string& why) {
  if (wrong) throw UserError(why);
}

/// Bytes of the largest table or record that is read; meshes and matrices may be larger.
constexpr std::uintmax_t largest_text = 512'000'000;

/// Throws UserError when a path names something that may have no end or no content, which a reader
/// must not wait for: a folder, a device, a pipe or a socket; and when it is a file of more than
/// `most` bytes. A path with nothing there passes: its reader knows the expected one. `place`
/// precedes the path in the message, such as "option -ensemble ".
void require_finite_file(const std::string& path, const std::string& place = "",
                         std::uintmax_t most = std::numeric_limits<std::uintmax_t>::max());

/// A place as messages name it: (x, y, z) with six digits [m].
std::string place_text(const Vector3& place);

}  // namespace pounding
