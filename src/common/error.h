#pragma once

#include <stdexcept>
#include <string>

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

}  // namespace pounding
