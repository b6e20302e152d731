#include "observers/kinds.h"

#include "observers/contact_watches.h"
#include "observers/field_writer.h"
#include "observers/floor_spectra.h"
#include "observers/forces.h"
#include "observers/loops.h"
#include "observers/model_file.h"
#include "observers/recorder.h"
#include "observers/run_progress.h"
#include "observers/watchdog.h"
#include "observers/yield_table.h"

namespace pounding {

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
      uplift_output(),
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
