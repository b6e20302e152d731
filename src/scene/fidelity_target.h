#pragma once

#include <string>

#include "scene/option_table.h"

namespace pounding {

/// The options of a scene with the choice of `-fidelity_target` among them.
struct ChosenFidelity {
  OptionsDatabase options;
  std::string note;  ///< the choice and its reason, in one line; empty without a target
};

/// `-fidelity_target E` takes, from the table of settings that run/tradeoff measured
/// (`-fidelity_table`), the fastest whose floor spectra differed from full order by at most E (rms
/// of the natural logarithm of their ratio, 1-400 Hz, in the worst of its cases), and sets its
/// options for every structure. A setting one of whose options the user gave another value is
/// passed over. Without the target nothing changes.
///
/// An error that was measured on some structures says nothing of others: the table names those of
/// the study in a line "# structures: KEY what they are", and a scene whose `structures_key` (see
/// scene/structures_key.h) is another one is refused.
///
/// The table is a CSV file with the columns setting, rms, cost (wall time over motion) and options:
/// words name=value, each set for every structure (`model=modal` becomes `-<structure>_model
/// modal`), those that begin with a dash (`-courant=0.99`) for the run. Throws UserError.
ChosenFidelity choose_fidelity(const OptionsDatabase& given, const std::string& structures_key);

}  // namespace pounding
