#include "observers/kinds.h"

namespace pounding {

// Each at the end of its file.
OutputKind spectra_output();
OutputKind law_loops_output();
OutputKind model_output();
OutputKind impact_output();
OutputKind contact_history_output();
OutputKind loops_output();
OutputKind struck_output();
OutputKind uplift_output();
OutputKind pool_output();
OutputKind forces_output();
OutputKind history_output();
OutputKind fields_output();
OutputKind slide_output();
OutputKind energy_output();
OutputKind yield_output();
OutputKind progress_output();

const std::vector<OutputKind>& output_kinds() {
  static const std::vector<OutputKind> kinds{
      {{{"resolved.yaml", "the options in force, and the hashes of the inputs"},
        {"summary.json", "every number that the run printed"}}},
      spectra_output(),
      law_loops_output(),
      model_output(),
      impact_output(),
      contact_history_output(),
      loops_output(),
      struck_output(),
      uplift_output(),
      pool_output(),
      forces_output(),
      history_output(),
      fields_output(),
      slide_output(),
      energy_output(),
      yield_output(),
      progress_output(),
      {{{"checkpoint.h5", "the state from which the run goes on", "", true}}},
  };
  return kinds;
}

const std::vector<ResultFile>& result_files() {
  static const std::vector<ResultFile> files = [] {
    std::vector<ResultFile> all;
    for (const OutputKind& kind : output_kinds()) {
      all.insert(all.end(), kind.files.begin(), kind.files.end());
    }
    return all;
  }();
  return files;
}

Observers make_observers(const ObservedRun& run, Profile& profile, bool in_member) {
  Observers all(profile);
  for (const OutputKind& kind : output_kinds()) {
    if (kind.make == nullptr || (in_member && !kind.in_members)) continue;
    if (kind.asked == nullptr || kind.asked(run)) all.add(kind.make(run, all));
  }
  return all;
}

}  // namespace pounding
