#pragma once

#include <string>
#include <vector>

#include "motion/signal_treatment.h"
#include "spectra/spectra_options.h"

namespace pounding {

/// One acceleration of a file, with the kind of the file.
struct NamedSignal {
  std::string
      name;  ///< channel, or column of a record; behind the file's name if there are several
  SampledSignal signal;
  std::string folder;       ///< of the file, "." for the current one
  bool is_history = false;  ///< written by a run
};

/// Reads the channels of every file, in the order asked. Throws UserError or std::runtime_error
/// (one line) for files that cannot be read and channels that are not there.
std::vector<NamedSignal> read_signals(const SpectraOptions& options);

}  // namespace pounding
