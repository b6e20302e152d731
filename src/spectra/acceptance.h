#pragma once

#include <span>
#include <string>

namespace pounding {

/// Judges motions by a table of rules: the Python package takes this process over, with the words
/// of the command line, and gives its exit status. Throws UserError where it is not there.
[[noreturn]] void judge_motions(std::span<const std::string> words);

}  // namespace pounding
