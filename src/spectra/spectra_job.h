#pragma once

#include "spectra/spectra_options.h"

namespace pounding {

/// Reads the signals, computes the spectra and writes the tables. Serial. Throws UserError or
/// std::runtime_error, one line each.
void run_spectra(const SpectraOptions& options);

}  // namespace pounding
